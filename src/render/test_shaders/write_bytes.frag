// Every byte value in each channel, by column.
layout(location = 0) out uvec4 bytes;

void main() {
  uint x = uint(gl_FragCoord.x);
  bytes = uvec4(x, 255u - x, x ^ 0x55u, (x * 7u) & 255u);
}
