#include "cli/common/interruption.h"

#include <pthread.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>

#include "cli/common/staging.h"

namespace hemitex::cli {
namespace {

/// Signals reach a process, not an object. Never destroyed, because a signal may arrive until the very end.
struct Shared {
  std::atomic<int> longRuns = 0, signal = 0;
  std::atomic<bool> isStopping = false;
};

Shared& shared() {
  static Shared& state = *new Shared;
  return state;
}

sigset_t watchedSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int number : {SIGINT, SIGTERM}) {
    struct sigaction present = {};
    // A shell starts commands in the background with SIGINT ignored.
    if (sigaction(number, nullptr, &present) == 0 && present.sa_handler != SIG_IGN) sigaddset(&signals, number);
  }
  return signals;
}

/// Says that the run ends. The console belongs to another thread; its bar is removed.
void tellEnd() {
  std::string text = "hemitex: a signal ended the run at once, without a result\n";
  if (isatty(STDERR_FILENO) != 0) text.insert(0, "\r\033[K");
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
}

void waitForSignals(const sigset_t& signals) {
  int number = 0;
  while (sigwait(&signals, &number) == 0) {
    shared().signal = number;
    if (shared().longRuns > 0 && !shared().isStopping.exchange(true)) continue;
    removeTemporaryFolders();
    tellEnd();
    std::_Exit(*stoppedExitCode());
  }
}

}  // namespace

void watchSignals() {
  shared();
  const sigset_t signals = watchedSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals] { waitForSignals(signals); }).detach();
}

LongRun::LongRun() { ++shared().longRuns; }

LongRun::~LongRun() { --shared().longRuns; }

const std::atomic<bool>& LongRun::isStopping() { return shared().isStopping; }

std::optional<int> stoppedExitCode() {
  const int signal = shared().signal;
  return signal ? std::optional(128 + signal) : std::nullopt;
}

}  // namespace hemitex::cli
