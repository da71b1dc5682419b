// What compare_page.cpp puts around its pictures and numbers. Private to this folder.
#pragma once

#include <string_view>

namespace lucerna::app {

extern const std::string_view kComparePageStyle;
extern const std::string_view kComparePageStage;  // the HTML of controls, drawing and read-out
extern const std::string_view
    kComparePageScript;  // works on them; the parts are named by their ids

}  // namespace lucerna::app
