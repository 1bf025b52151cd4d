#include "integration/workers.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace cdcr::detail {
namespace {

// How long the caller waits for the other threads between two looks at its progress.
constexpr std::chrono::milliseconds pause{20};

class Workers {
 public:
  Workers(Index count, const std::function<void(Index, const GoOn&)>& task,
          const std::function<bool(Index)>& progress)
      : count_(count), task_(task), progress_(progress) {}

  void run(Index threads) {
    std::vector<std::thread> others;
    for (Index i = 1; i < threads; ++i) {
      try {
        others.emplace_back([this] {
          work([this] { return !stop_; });
          const std::lock_guard lock(mutex_);
          ++finished_;
          all_finished_.notify_one();
        });
      } catch (const std::system_error&) {  // no more threads to be had
        break;
      }
    }
    const auto ask = [this] {
      if (!stop_ && progress_ && !progress_(ended_)) stop_ = true;
      return !stop_;
    };
    work(ask);
    wait_for(others.size(), ask);
    guarded([&] { ask(); });  // of the last
    for (std::thread& other : others) other.join();
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  void work(const GoOn& go_on) noexcept {
    guarded([&] {
      for (Index i = next_++; i < count_ && go_on(); i = next_++) {
        task_(i, go_on);
        ++ended_;
      }
    });
  }

  void wait_for(std::size_t others, const GoOn& ask) noexcept {
    std::unique_lock lock(mutex_);
    while (finished_ < others) {
      all_finished_.wait_for(lock, pause);
      lock.unlock();
      guarded([&] { ask(); });
      lock.lock();
    }
  }

  /// Keeps the first that is thrown, for the caller.
  template <class F>
  void guarded(const F& f) noexcept {
    try {
      f();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!thrown_) thrown_ = std::current_exception();
      stop_ = true;
    }
  }

  Index count_;
  const std::function<void(Index, const GoOn&)>& task_;
  const std::function<bool(Index)>& progress_;
  std::atomic<Index> next_{0}, ended_{0};
  std::atomic<bool> stop_{false};
  std::mutex mutex_;  // of what follows
  std::condition_variable all_finished_;
  std::size_t finished_ = 0;
  std::exception_ptr thrown_;
};

}  // namespace

void for_each_task(Index count, int threads, const std::function<void(Index, const GoOn&)>& task,
                   const std::function<bool(Index)>& progress) {
  const Index processors = threads > 0 ? threads : std::thread::hardware_concurrency();
  Workers(count, task, progress).run(std::clamp<Index>(processors, 1, std::max<Index>(count, 1)));
}

}  // namespace cdcr::detail
