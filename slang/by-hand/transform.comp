// stages/transform.slang and geometry/project.slang by hand, in GLSL: the same operations in the same order. Each float
// result is `precise`, so no driver contracts two operations into one. A lane does one vertex.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "settings.glsl"  // kClip, kPerspective, kSubPixelBits

layout(local_size_x = 64) in;

// The host binds by name, so `frame` needs only the fields that are used here.
layout(std140, binding = 0) uniform Frame {
    uint vertexCount;
    float halfWidth, halfHeight, guardX, guardY;
    float m00, m01, m02, m03, m10, m11, m12, m13, m20, m21, m22, m23, m30, m31, m32, m33;
} frame;

struct Corner { int x, y; float z; uint flags; };  // slang/records/layout.slang
const uint kOutside = 1, kNonFinite = 2, kBehind = 4;
const uint kGroupRow = 32768;                      // slang/machine/workgroup.slang
const float kSnapLimit = 16777216.0;

layout(std430, binding = 1) readonly buffer Positions { float positions[]; };
layout(std430, binding = 2) writeonly buffer ClipSpace { vec4 clipSpace[]; };
layout(std430, binding = 3) writeonly buffer Corners { Corner corners[]; };

bool isFinite(float a) { return (floatBitsToUint(a) & 0x7f800000u) != 0x7f800000u; }

// The integer nearest to a, ties to even, for |a| < 2^24.
int nearestEven(float a)
{
    const float whole = floor(a);
    precise const float part = a - whole;
    const int n = int(whole);
    return n + (int(part > 0.5) | (int(part == 0.5) & n & 1));
}

// A position in pixels to the nearest point of the grid of 2^-kSubPixelBits pixels, in 1/256 pixel. Where kSubPixelBits
// is 0, the points of the grid are the samples.
int snap(float s)
{
    if (kSubPixelBits == 0) {
        precise const float shifted = s - 0.5;
        return nearestEven(shifted) * 256 + 128;
    }
    precise const float scaled = s * float(1 << kSubPixelBits);
    return nearestEven(scaled) << (8 - kSubPixelBits);
}

bool insideAll(vec4 p)
{
    precise const float beyond = p.w - p.z;
    precise const float x = frame.guardX * p.w, left = x + p.x, right = x - p.x;
    precise const float y = frame.guardY * p.w, top = y + p.y, bottom = y - p.y;
    return p.z >= 0.0 && beyond >= 0.0 && left >= 0.0 && right >= 0.0 && top >= 0.0 && bottom >= 0.0;
}

Corner project(vec4 p)
{
    uint flags = isFinite(p.x) && isFinite(p.y) && isFinite(p.z) && isFinite(p.w) ? 0u : kNonFinite;
    if (kClip && !insideAll(p))
        flags |= kOutside;
    precise float x = p.x, y = p.y, z = p.z;
    bool usable = true;
    if (kPerspective) {
        precise const float r = 1.0 / p.w;
        usable = p.w > 0.0 && isFinite(r);
        x = x * r;
        y = y * r;
        z = z * r;
    }
    precise const float sx = x * frame.halfWidth + frame.halfWidth, sy = y * frame.halfHeight + frame.halfHeight;
    precise const float gridX = sx * 256.0, gridY = sy * 256.0;
    usable = usable && abs(gridX) <= kSnapLimit && abs(gridY) <= kSnapLimit;
    if (!usable)
        flags |= kBehind;
    const float depth = z > 0.0 ? (z < 1.0 ? z : 1.0) : 0.0;
    return Corner(snap(usable ? sx : 0.0), snap(usable ? sy : 0.0), depth, flags);
}

void main()
{
    const uint v = (gl_WorkGroupID.x + gl_WorkGroupID.y * kGroupRow) * 64 + gl_LocalInvocationID.x;
    if (v >= frame.vertexCount)
        return;
    const float x = positions[3 * v], y = positions[3 * v + 1], z = positions[3 * v + 2];
    precise vec4 c;
    c.x = ((frame.m00 * x + frame.m01 * y) + frame.m02 * z) + frame.m03;
    c.y = ((frame.m10 * x + frame.m11 * y) + frame.m12 * z) + frame.m13;
    c.z = ((frame.m20 * x + frame.m21 * y) + frame.m22 * z) + frame.m23;
    c.w = ((frame.m30 * x + frame.m31 * y) + frame.m32 * z) + frame.m33;
    clipSpace[v] = c;
    corners[v] = project(c);
}
