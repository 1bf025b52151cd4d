#pragma once

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace cdcr::detail {

inline std::string indexed(const std::string& item, std::size_t k) {
  return item + "[" + std::to_string(k) + "]";
}

/// Collects sentences of the form "section 1: length must be > 0 m and finite, got -1".
class Check {
 public:
  void positive(const std::string& item, double value, const char* unit) {
    if (!(value > 0.0) || !std::isfinite(value)) refuse(item, range("> 0", unit), value);
  }
  void not_negative(const std::string& item, double value, const char* unit) {
    if (!(value >= 0.0) || !std::isfinite(value)) refuse(item, range(">= 0", unit), value);
  }
  void fraction(const std::string& item, double value) {
    if (!(value >= 0.0 && value <= 1.0)) refuse(item, "0 to 1", value);
  }
  void finite(const std::string& item, double value, const char* unit) {
    const std::string of_unit = *unit != '\0' ? std::string(" of ") + unit : "";
    if (!std::isfinite(value)) refuse(item, "a finite number" + of_unit, value);
  }
  void count(const std::string& item, long long value, long long low, long long high) {
    if (value < low || value > high) {
      refuse(item, std::to_string(low) + " to " + std::to_string(high), value);
    }
  }
  template <typename Value>
  void refuse(const std::string& item, const std::string& wanted, const Value& value) {
    std::ostringstream text;
    text.precision(12);
    text << item << " must be " << wanted << ", got " << value;
    found.push_back(text.str());
  }

  std::vector<std::string> found;

 private:
  static std::string range(const char* range, const char* unit) {
    return std::string(range) + (*unit != '\0' ? " " : "") + unit + " and finite";
  }
};

}  // namespace cdcr::detail
