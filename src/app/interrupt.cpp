#include "app/interrupt.h"

#include <array>
#include <atomic>
#include <csignal>

namespace portalens {
namespace {

constexpr std::array<int, 3> ends = {SIGINT, SIGTERM, SIGHUP};

// A signal handler can reach nothing but what is static.
std::atomic<int> ended{0};
std::atomic<bool> look{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

extern "C" void remember_end(int signal) {
  ended = signal;
  for (const int one : ends) std::signal(one, SIG_DFL);
}

extern "C" void remember_look(int) { look = true; }

}  // namespace

Signals::Signals() {
  ended = 0;
  look = false;
  std::signal(SIGUSR1, remember_look);
}

Signals::~Signals() {
  for (const int one : ends) std::signal(one, SIG_DFL);
  std::signal(SIGUSR1, SIG_IGN);
}

void Signals::hold_ends() {
  std::signal(SIGINT, remember_end);
  std::signal(SIGTERM, remember_end);
  if (std::signal(SIGHUP, remember_end) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

int Signals::ended_by() const { return ended; }

bool Signals::take_look() { return look.exchange(false); }

}  // namespace portalens
