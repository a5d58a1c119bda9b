#version 450
layout(location = 0) out uint id;
void main() { id = uint(gl_PrimitiveID); }
