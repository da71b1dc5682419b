// How long something takes, for people.
#pragma once

#include <string>

namespace lucerna {

// "0.4 s", "18 s", "3 min 5 s", "5 h 40 min", "3 d 4 h".
std::string secondsText(double seconds);

// An estimate that may be off by `margin`: "about 18 s, give or take 4 s"; "at most 31 s", their
// sum, where the margin is the larger.
std::string aboutText(double seconds, double margin);

}  // namespace lucerna
