// A bit for each layer: whether its byte is below one half.
uniform usampler2DArray shadowValues;  // four layers in each array layer
uniform int arrayLayers;

layout(location = 0) out uint mask;

void main() {
  mask = 0u;
  for (int i = 0; i < arrayLayers; ++i) {
    uint dark = ~texelFetch(shadowValues, ivec3(gl_FragCoord.xy, i), 0).r >> 7;
    mask |= (dark & 1u | dark >> 7 & 2u | dark >> 14 & 4u | dark >> 21 & 8u) << uint(4 * i);
  }
}
