#pragma once

#include <map>
#include <string>
#include <vector>

#include "cdcr/types.hpp"

namespace cdcr::test {

/// A value of a JSON file: as much of the language as the files of tests/data use.
class Json {
 public:
  /// Throws std::runtime_error where the file cannot be read.
  static Json load(const std::string& path);

  [[nodiscard]] const Json& operator[](const std::string& key) const { return members_.at(key); }
  [[nodiscard]] const std::vector<Json>& items() const { return items_; }
  [[nodiscard]] double number() const { return number_; }
  [[nodiscard]] int integer() const { return static_cast<int>(number_); }
  /// A list of numbers, and a list of such.
  [[nodiscard]] VectorXd vector() const;
  [[nodiscard]] MatrixXd matrix() const;

 private:
  struct Reader;

  double number_ = 0.0;
  std::vector<Json> items_;
  std::map<std::string, Json> members_;
};

}  // namespace cdcr::test
