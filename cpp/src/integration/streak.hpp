#pragma once

namespace cdcr::detail {

/// Counts what happens in step after step: `most` times with no more than `most_free` steps free
/// of it between any two.
class Streak {
 public:
  void happens() noexcept {
    ++count_;
    free_ = 0;
  }
  void step() noexcept {
    if (++free_ > most_free) count_ = 0;
  }
  [[nodiscard]] bool too_long() const noexcept { return count_ >= most; }

 private:
  static constexpr int most = 20;
  static constexpr int most_free = 40;  // a step cut grows again after its order, 12, plus one
  int count_ = 0, free_ = 0;
};

}  // namespace cdcr::detail
