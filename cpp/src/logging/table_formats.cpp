// Logs as CSV, and as an array of records in NumPy's format 2.0:
// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "logging/log_format.hpp"

namespace cdcr::detail {
namespace {

class Csv final : public LogFormat {
 public:
  using LogFormat::LogFormat;
  [[nodiscard]] std::string head(long long /*rows*/) const override {
    std::string line;
    for (const LogColumn& column : columns()) {
      line += (line.empty() ? "" : ",") + column.name + " [" + column.unit + "]";
    }
    return line + "\n";
  }
  void append(const ConstVectorRef& row, long long /*number*/, std::string& bytes) const override {
    for (Index i = 0; i < row.size(); ++i) {
      if (i > 0) bytes += ',';
      append_number(row[i], bytes);
    }
    bytes += '\n';
  }
};

class NumPy final : public LogFormat {
 public:
  using LogFormat::LogFormat;
  [[nodiscard]] std::string head(long long rows) const override {
    constexpr std::size_t digits = 20, before = 12,
                          whole = 64;  // of a count; bytes before the text
    std::string text = "{'descr': [";
    for (const LogColumn& column : columns()) text += "('" + column.name + "', '<f8'), ";
    std::string count = std::to_string(rows);
    count.resize(digits, ' ');
    text += "], 'fortran_order': False, 'shape': (" + count + ",), }";
    text.append(whole - 1 - (before + text.size()) % whole, ' ');
    text += '\n';
    std::string bytes("\x93NUMPY\x02\x00", 8);
    append_bytes(static_cast<std::uint32_t>(text.size()), bytes);
    return bytes + text;
  }
  void append(const ConstVectorRef& row, long long /*number*/, std::string& bytes) const override {
    for (const double number : row) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &number, sizeof bits);
      append_bytes(bits, bytes);
    }
  }
};

}  // namespace

void append_number(double number, std::string& text) {
  std::array<char, 32> room{};
#ifdef __cpp_lib_to_chars
  text.append(room.data(), std::to_chars(room.data(), room.data() + room.size(), number).ptr);
#else  // libstdc++ before 11
  const int size = std::snprintf(room.data(), room.size(), "%.17g", number);
  std::replace(room.begin(), room.begin() + size, ',', '.');  // of a locale
  text.append(room.data(), static_cast<std::size_t>(size));
#endif
}

LogFormatPtr csv_format(const std::vector<LogColumn>& columns) {
  return std::make_unique<Csv>(columns);
}

LogFormatPtr numpy_format(const std::vector<LogColumn>& columns) {
  return std::make_unique<NumPy>(columns);
}

}  // namespace cdcr::detail
