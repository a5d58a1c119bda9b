// A stage in HLSL: paints each pixel by its row and column, red to the right and green downwards, and what is empty blue.
struct Frame { uint width, rowBegin, rowEnd; };
ConstantBuffer<Frame> frame;
StructuredBuffer<uint> ids;
RWStructuredBuffer<float> colour;

[numthreads(64, 1, 1)]
void paint(uint3 group : SV_GroupID, uint lane : SV_GroupIndex)
{
    const uint pixel = (group.x + group.y * 32768) * 64 + lane;
    const uint rows = frame.rowEnd - frame.rowBegin;
    if (pixel >= rows * frame.width)
        return;
    const bool empty = ids[pixel] == 0xffffffffu;
    colour[3 * pixel] = empty ? 0.0f : float(pixel % frame.width) / float(frame.width);
    colour[3 * pixel + 1] = empty ? 0.0f : float(pixel / frame.width) / float(rows);
    colour[3 * pixel + 2] = empty ? 1.0f : 0.0f;
}
