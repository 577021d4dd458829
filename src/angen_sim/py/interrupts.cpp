#include "py/interrupts.h"

#include <sys/syscall.h>
#include <unistd.h>

namespace angen::py {

namespace {

volatile std::sig_atomic_t held = 0;  // signals since the handler was set
struct sigaction before;

void hold(int number) {
  held = held + 1;
  if (held < 2) return;
  sigaction(SIGINT, &before, nullptr);
  raise(number);
}

bool in_main_thread() { return syscall(SYS_gettid) == getpid(); }

}  // namespace

Interrupts::Interrupts() {
  struct sigaction now {};
  if (!in_main_thread() || sigaction(SIGINT, nullptr, &now) != 0) return;
  const bool is_simple = (now.sa_flags & SA_SIGINFO) == 0;
  if (is_simple &&
      (now.sa_handler == SIG_DFL || now.sa_handler == SIG_IGN || now.sa_handler == &hold)) {
    return;  // nobody catches it, or another run around this one holds it
  }
  held = 0;
  before = now;
  struct sigaction ours {};
  ours.sa_handler = &hold;
  sigemptyset(&ours.sa_mask);
  holds_ = sigaction(SIGINT, &ours, nullptr) == 0;
}

Interrupts::~Interrupts() {
  if (!holds_) return;
  sigaction(SIGINT, &before, nullptr);
  if (held == 1) raise(SIGINT);
}

bool Interrupts::came() const { return holds_ && held != 0; }

}  // namespace angen::py
