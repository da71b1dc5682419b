// The one translation unit of stb_image; warnings are off for it (see CMakeLists.txt).
#include <cstdlib>

namespace {
// Zeroed, so that the pixels of a truncated file never depend on what memory held before.
void* zeroedMemory(std::size_t size) {
  return std::calloc(size, 1);
}
}  // namespace

#define STBI_MALLOC(size) zeroedMemory(size)
#define STBI_REALLOC(pointer, size) std::realloc(pointer, size)
#define STBI_FREE(pointer) std::free(pointer)
#define STBI_NO_STDIO
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
