#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "cdcr/export.hpp"
#include "cdcr/types.hpp"

namespace CDCR_EXPORT cdcr {

/// What a number in each row of a log is, and the topic that it is told under in an MCAP file.
struct LogColumn {
  std::string name, unit, topic;
};

/// Rows of numbers on their way from a loop to a file, a ring between two threads.
///
/// One thread pushes, one pops, which may be the same. Neither waits for the other: a row for which
/// there is no room is dropped, and counted. The constructor allocates and throws
/// std::invalid_argument.
class Log {
 public:
  /// The first column is the time, "t" in "s". Room for `capacity` rows or a few more, 1 to 2^24.
  explicit Log(std::vector<LogColumn> columns, Index capacity = 8192);

  [[nodiscard]] const std::vector<LogColumn>& columns() const noexcept { return columns_; }
  [[nodiscard]] Index capacity() const noexcept { return rows_.cols(); }

  /// False where there is no room, or the row has another size than the columns. Real-time safe.
  bool push(const ConstVectorRef& row) noexcept;
  /// The oldest row; false where there is none. Real-time safe.
  [[nodiscard]] bool pop(VectorRef row) noexcept;
  /// Rows that found no room. Real-time safe.
  [[nodiscard]] long dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::vector<LogColumn> columns_;
  MatrixXd rows_;  // (columns, capacity), a power of 2
  std::atomic<std::size_t> pushed_{0}, popped_{0};
  std::atomic<long> dropped_{0};
};

/// A file of such rows: text (.csv), an array of records for numpy.load (.npy), or JSON messages
/// with their schemas, a topic each (.mcap), which Foxglove opens. It keeps every bit.
class LogFile {
 public:
  /// Replaces a file that is there. Throws std::invalid_argument where the ending is another one,
  /// or the file cannot be written.
  LogFile(const std::string& path, const std::vector<LogColumn>& columns);
  ~LogFile();
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  /// Throws std::runtime_error where it cannot be written.
  void write(const ConstVectorRef& row);
  /// Writes all rows that a log has; how many there were.
  Index take(Log& log);
  /// From here on others can read what has been written. Throws std::runtime_error.
  void flush();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Writes a log to a file from a thread of its own, which looks for rows now and then.
class LogWriter {
 public:
  /// Refers to the log, which must outlive it; looks each `period` [s]. Throws as LogFile.
  LogWriter(Log& log, const std::string& path, double period = 0.05);
  ~LogWriter();  ///< As close, but says nothing of what went wrong.
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Writes what is left and ends the thread. Throws std::runtime_error where the file could not
  /// be written.
  void close();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace CDCR_EXPORT cdcr
