#version 450
layout(location = 0) in vec4 clipPosition;
void main() { gl_Position = clipPosition; }
