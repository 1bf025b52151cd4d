#include "cdcr/log.hpp"

#include <algorithm>
#include <utility>

#include "base/arguments.hpp"

namespace cdcr {
namespace {

static_assert(std::atomic<std::size_t>::is_always_lock_free);

constexpr Index most_rows = 16777216;  // 2^24

/// Names and units go into three formats as they are.
bool is_plain(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) {
    return c >= ' ' && c <= '~' && c != ',' && c != '"' && c != '\'' && c != '\\';
  });
}

Index power_of_two(Index at_least) {
  Index found = 1;
  while (found < at_least) found *= 2;
  return found;
}

}  // namespace

Log::Log(std::vector<LogColumn> columns, Index capacity) : columns_(std::move(columns)) {
  detail::require(!columns_.empty() && columns_[0].name == "t" && columns_[0].unit == "s",
                  "the first column of a log must be t in s, got ",
                  columns_.empty() ? "none" : columns_[0].name + " in " + columns_[0].unit);
  detail::require(capacity >= 1 && capacity <= most_rows, "capacity of a log must be 1 to ",
                  most_rows, " rows, got ", capacity);
  for (const LogColumn& column : columns_) {
    for (const std::string& text : {column.name, column.unit, column.topic}) {
      detail::require(is_plain(text), "names in a log must be of ASCII letters without comma, ",
                      "quotes and backslash, got ", text);
    }
  }
  rows_ = MatrixXd::Zero(static_cast<Index>(columns_.size()), power_of_two(capacity));
}

// Counts of rows only grow, and wrap at a power of two as their places do. The thread that pushes
// alone writes pushed_, and lets it be seen after the row; popped_ likewise.
bool Log::push(const ConstVectorRef& row) noexcept {
  if (row.size() != rows_.rows()) return false;
  const std::size_t pushed = pushed_.load(std::memory_order_relaxed);
  const auto room = static_cast<std::size_t>(capacity());
  if (pushed - popped_.load(std::memory_order_acquire) == room) {
    dropped_.fetch_add(1, std::memory_order_relaxed);
    return false;
  }
  rows_.col(static_cast<Index>(pushed % room)) = row;
  pushed_.store(pushed + 1, std::memory_order_release);
  return true;
}

bool Log::pop(VectorRef row) noexcept {
  const std::size_t popped = popped_.load(std::memory_order_relaxed);
  if (row.size() != rows_.rows() || popped == pushed_.load(std::memory_order_acquire)) return false;
  row = rows_.col(static_cast<Index>(popped % static_cast<std::size_t>(capacity())));
  popped_.store(popped + 1, std::memory_order_release);
  return true;
}

}  // namespace cdcr
