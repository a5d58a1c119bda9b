// slang/stages/transform.slang and slang/geometry/project.slang by hand, in HLSL: the same operations in the same order. One vertex a lane; on the CPU
// one thread is the whole group, so it loops over the lanes.
import settings;    // kClip, kPerspective, kSubPixelBits
import workgroup;   // lanes and groups

// Bound by name: of `frame` only what is used here.
struct Frame
{
    uint vertexCount;
    float halfWidth, halfHeight, guardX, guardY;
    float m00, m01, m02, m03, m10, m11, m12, m13, m20, m21, m22, m23, m30, m31, m32, m33;
};
struct Corner { int x, y; float z; uint flags; };   // slang/records/layout.slang
static const uint kOutside = 1, kNonFinite = 2, kBehind = 4;
static const float kSnapLimit = 16777216.0;

ConstantBuffer<Frame> frame;
StructuredBuffer<float> positions;
RWStructuredBuffer<float4> clipSpace;
RWStructuredBuffer<Corner> corners;

bool finite(float a) { return (asuint(a) & 0x7f800000u) != 0x7f800000u; }

// Nearest integer, ties to even, for |a| < 2^24.
int nearest(float a)
{
    const float whole = floor(a);
    const float part = a - whole;
    const int n = int(whole);
    return n + (int(part > 0.5) | (int(part == 0.5) & n & 1));
}

// A position in pixels to the grid of 2^-kSubPixelBits pixels, in 1/256 pixel. The grid of 0 bits is that of the samples.
int snap(float s)
{
    if (kSubPixelBits == 0)
        return nearest(s - 0.5) * 256 + 128;
    return nearest(s * float(1 << kSubPixelBits)) * (256 >> kSubPixelBits);
}

bool insideAll(float4 p)
{
    const float x = frame.guardX * p.w, y = frame.guardY * p.w;
    return p.z >= 0 && p.w - p.z >= 0 && x + p.x >= 0 && x - p.x >= 0 && y + p.y >= 0 && y - p.y >= 0;
}

Corner place(float4 p)
{
    Corner c;
    c.flags = finite(p.x) && finite(p.y) && finite(p.z) && finite(p.w) ? 0 : kNonFinite;
    if (kClip && !insideAll(p))
        c.flags |= kOutside;
    float x = p.x, y = p.y, z = p.z;
    bool usable = true;
    if (kPerspective)
    {
        const float r = 1.0 / p.w;
        usable = p.w > 0 && finite(r);
        x = x * r;
        y = y * r;
        z = z * r;
    }
    const float sx = x * frame.halfWidth + frame.halfWidth, sy = y * frame.halfHeight + frame.halfHeight;
    usable = usable && abs(sx * 256.0) <= kSnapLimit && abs(sy * 256.0) <= kSnapLimit;
    if (!usable)
        c.flags |= kBehind;
    c.x = snap(usable ? sx : 0.0);
    c.y = snap(usable ? sy : 0.0);
    c.z = z > 0 ? (z < 1 ? z : 1) : 0;
    return c;
}

[numthreads(kThreadsPerGroup, 1, 1)]
void transform(uint3 group : SV_GroupID, uint thread : SV_GroupIndex)
{
    for (int k = 0; k < kLanesPerThread; ++k)
    {
        const uint v = groupIndex(group) * kLanes + laneOf(k, thread);
        if (v >= frame.vertexCount)
            continue;
        const float x = positions[3 * v], y = positions[3 * v + 1], z = positions[3 * v + 2];
        float4 c;
        c.x = ((frame.m00 * x + frame.m01 * y) + frame.m02 * z) + frame.m03;
        c.y = ((frame.m10 * x + frame.m11 * y) + frame.m12 * z) + frame.m13;
        c.z = ((frame.m20 * x + frame.m21 * y) + frame.m22 * z) + frame.m23;
        c.w = ((frame.m30 * x + frame.m31 * y) + frame.m32 * z) + frame.m33;
        clipSpace[v] = c;
        corners[v] = place(c);
    }
}
