// What Fullscreen draws until a row names a shader of its own.
uniform sampler2D color;  // The picture to copy.

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 copied;

void main() { copied = texture(color, uv); }
