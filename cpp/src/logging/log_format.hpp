#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cdcr/log.hpp"

namespace cdcr::detail {

/// The bytes of a log: a head, whose length does not depend on the number of rows, the rows, an
/// end.
class LogFormat {
 public:
  explicit LogFormat(std::vector<LogColumn> columns) : columns_(std::move(columns)) {}
  virtual ~LogFormat() = default;
  [[nodiscard]] virtual std::string head(long long rows) const = 0;
  virtual void append(const ConstVectorRef& row, long long number, std::string& bytes) const = 0;
  [[nodiscard]] virtual std::string end() const { return {}; }

 protected:
  [[nodiscard]] const std::vector<LogColumn>& columns() const { return columns_; }

 private:
  std::vector<LogColumn> columns_;
};

using LogFormatPtr = std::unique_ptr<const LogFormat>;
[[nodiscard]] LogFormatPtr csv_format(const std::vector<LogColumn>& columns);
[[nodiscard]] LogFormatPtr numpy_format(const std::vector<LogColumn>& columns);
[[nodiscard]] LogFormatPtr mcap_format(const std::vector<LogColumn>& columns);

/// Text from which every bit can be read back, whatever the locale.
void append_number(double number, std::string& text);

/// The least significant byte first.
template <class Unsigned>
void append_bytes(Unsigned number, std::string& bytes) {
  for (std::size_t i = 0; i < sizeof number; ++i) {
    bytes += static_cast<char>(static_cast<unsigned char>(number >> (8 * i)));
  }
}

}  // namespace cdcr::detail
