#pragma once

#include <csignal>

namespace angen::py {

/// Holds Ctrl-C back in the main thread, so that methods of plug-ins run to their end. A second
/// Ctrl-C reaches them, as Python's KeyboardInterrupt.
class Interrupts {
 public:
  Interrupts();
  /// Raises the signal that was held back.
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  /// Whether Ctrl-C has come.
  bool came() const;

 private:
  bool holds_ = false;
};

}  // namespace angen::py
