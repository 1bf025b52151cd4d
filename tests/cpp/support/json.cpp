#include "json.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace cdcr::test {

struct Json::Reader {
  std::string text;
  std::size_t at = 0;

  /// The next character that is no space, which stays to be read.
  char next() {
    at = text.find_first_not_of(" \t\r\n", at);
    if (at == std::string::npos) throw std::runtime_error("JSON: the text ends too early");
    return text[at];
  }
  bool take(char wanted) {
    if (next() != wanted) return false;
    ++at;
    return true;
  }
  void expect(char wanted) {
    if (!take(wanted)) throw std::runtime_error("JSON: expected " + std::string(1, wanted));
  }
  std::string word() {
    expect('"');
    const std::size_t end = text.find('"', at);
    std::string found = text.substr(at, end - at);
    at = end + 1;
    return found;
  }
  Json value() {
    Json json;
    if (take('{')) {
      while (!take('}')) {
        std::string key = word();
        expect(':');
        json.members_.emplace(std::move(key), value());
        take(',');
      }
    } else if (take('[')) {
      while (!take(']')) {
        json.items_.push_back(value());
        take(',');
      }
    } else {
      std::size_t length = 0;
      json.number_ = std::stod(text.substr(at, 32), &length);
      at += length;
    }
    return json;
  }
};

Json Json::load(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("JSON: no file " + path);
  return Reader{{std::istreambuf_iterator<char>(file), {}}}.value();
}

VectorXd Json::vector() const {
  VectorXd v(static_cast<Index>(items_.size()));
  for (Index i = 0; i < v.size(); ++i) v[i] = items_[static_cast<std::size_t>(i)].number();
  return v;
}

MatrixXd Json::matrix() const {
  MatrixXd M(items_.size(), items_.empty() ? 0 : items_[0].items_.size());
  for (Index i = 0; i < M.rows(); ++i) {
    M.row(i) = items_[static_cast<std::size_t>(i)].vector().transpose();
  }
  return M;
}

}  // namespace cdcr::test
