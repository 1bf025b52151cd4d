#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "base/arguments.hpp"
#include "cdcr/log.hpp"

namespace cdcr {

// The lock is between this thread and the one that closes; a loop knows nothing of it.
struct LogWriter::Parts {
  Parts(Log& from, const std::string& path, double seconds)
      : log(from), file(path, from.columns()), period(seconds) {
    thread = std::thread([this] { work(); });
  }

  void work() {
    try {
      for (bool last = false; !last;) {
        {
          std::unique_lock lock(mutex);
          last = closing.wait_for(lock, period, [this] { return closed; });
        }
        if (file.take(log) > 0) file.flush();
      }
    } catch (const std::runtime_error& error) {
      trouble = error.what();
    }
  }

  void end() {
    {
      const std::lock_guard lock(mutex);
      closed = true;
    }
    closing.notify_one();
    if (thread.joinable()) thread.join();
  }

  Log& log;
  LogFile file;
  std::chrono::duration<double> period;
  std::mutex mutex;
  std::condition_variable closing;
  bool closed = false;
  std::string trouble;  // of the thread, told once it has ended
  std::thread thread;
};

LogWriter::LogWriter(Log& log, const std::string& path, double period) {
  detail::require_positive("period of a log's writer", period, "s");
  parts_ = std::make_unique<Parts>(log, path, period);
}

LogWriter::~LogWriter() {
  parts_->end();
}

void LogWriter::close() {
  parts_->end();
  if (!parts_->trouble.empty()) throw std::runtime_error(parts_->trouble);
}

}  // namespace cdcr
