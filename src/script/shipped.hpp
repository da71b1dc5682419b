// Text files that are compiled in: the shipped pipelines and the script prelude.
#pragma once

#include <span>
#include <string_view>

namespace lucerna::script {

struct EmbeddedText {
  std::string_view name;  // "deferred.js"
  std::string_view text;
};

std::span<const EmbeddedText> shippedPipelines();  // by name
std::string_view prelude();

}  // namespace lucerna::script
