// What assimp does not tell about OBJ's material libraries.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace lucerna::scene {

// The names of the materials that state a diffuse colour (Kd). assimp gives the others a grey.
std::set<std::string> materialsWithDiffuse(std::string_view library);

}  // namespace lucerna::scene
