// by-depth.slang in GLSL: paints each pixel by its depth, near black and far white.
#version 460

layout(local_size_x = 64) in;

layout(std140, binding = 0) uniform Frame { uint width, rowBegin, rowEnd; } frame;
layout(std430, binding = 1) readonly buffer Depth { float depth[]; };
layout(std430, binding = 2) writeonly buffer Colour { float colour[]; };  // 3 a pixel

void main()
{
    const uint pixel = (gl_WorkGroupID.x + gl_WorkGroupID.y * 32768) * 64 + gl_LocalInvocationID.x;
    if (pixel >= (frame.rowEnd - frame.rowBegin) * frame.width)
        return;
    for (uint channel = 0; channel < 3; ++channel)
        colour[3 * pixel + channel] = depth[pixel];
}
