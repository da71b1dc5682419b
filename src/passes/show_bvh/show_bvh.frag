uniform vec3 lineColor;   // linear

layout(location = 0) out vec4 color;

void main() { color = vec4(lineColor, 1.0); }
