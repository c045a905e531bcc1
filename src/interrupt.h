// A long loop that the user can end.
#pragma once
#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <thread>

namespace crestline {

// `ask` throws where the user wants an end. It is called at most ten times a second, and on thread
// 0 only, the one that R runs on; no exception leaves a loop that several threads share.
class Patience {
 public:
  explicit Patience(const std::function<void()>& ask) : ask_(ask), last_(Clock::now()) {}

  // Whether to stop. Any thread may ask.
  bool over(int thread = 0) {
    if (stopped_.load(std::memory_order_relaxed)) return true;
    if (thread != 0) return false;
    Clock::time_point now = Clock::now();
    if (now - last_ < std::chrono::milliseconds(100)) return false;
    last_ = now;
    try {
      ask_();
    } catch (...) {
      error_ = std::current_exception();
      stopped_ = true;
    }
    return stopped_;
  }

  // At the end of a thread's share of the work: thread 0 goes on asking until all of the team are
  // done.
  void wait_for_others(int thread, int team) {
    ++done_;
    if (thread != 0) return;
    while (done_ < team) {
      over();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  // After the loop, on thread 0: throws what `ask` has thrown.
  void finish() {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  const std::function<void()>& ask_;
  Clock::time_point last_;
  std::atomic<bool> stopped_{false};
  std::atomic<int> done_{0};
  std::exception_ptr error_;
};

}  // namespace crestline
