// Progress with an ETA on stderr (a bar on a terminal, a line every few seconds otherwise) and
// cancellation by Ctrl-C.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace lucerna {

class Progress {
 public:
  // total: the count of units that make 100 %. counted: what else is counted, as "rays"; how many a
  // second is shown.
  Progress(std::string label, std::uint64_t total, std::string counted = "");
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance(std::uint64_t units = 1, std::uint64_t counted = 0);  // any thread
  // True once the user pressed Ctrl-C: stop soon, keep what is done, return ErrorKind::Cancelled.
  static bool cancelled();
  // Installs the SIGINT handler; the second Ctrl-C kills.
  static void catchInterrupt();
  static void setVisible(bool visible);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lucerna
