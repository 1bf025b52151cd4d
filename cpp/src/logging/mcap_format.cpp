// Logs as MCAP, in one piece without an index: https://mcap.dev/spec. Topics are channels of JSON
// messages with JSON schemas, as in python/cdcr/runs/mcap_log.py.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "cdcr/version.hpp"
#include "logging/log_format.hpp"

namespace cdcr::detail {
namespace {

constexpr std::string_view magic("\x89MCAP0\r\n", 8);

enum class Kind : unsigned char { header = 1, footer, schema, channel, message, data_end = 15 };

void append_text(const std::string& text, std::string& bytes) {
  append_bytes(static_cast<std::uint32_t>(text.size()), bytes);
  bytes += text;
}

void append_record(Kind kind, const std::string& content, std::string& bytes) {
  bytes += static_cast<char>(kind);
  append_bytes(static_cast<std::uint64_t>(content.size()), bytes);
  bytes += content;
}

struct Topic {
  std::string name;
  std::vector<Index> columns;
};

/// In the order in which columns name them; the time, which each message has, is in none.
std::vector<Topic> topics_of(const std::vector<LogColumn>& columns) {
  std::vector<Topic> found;
  for (std::size_t i = 1; i < columns.size(); ++i) {
    Topic* mine = nullptr;
    for (Topic& one : found) mine = one.name == columns[i].topic ? &one : mine;
    if (mine == nullptr) mine = &found.emplace_back(Topic{columns[i].topic, {}});
    mine->columns.push_back(static_cast<Index>(i));
  }
  return found;
}

class Mcap final : public LogFormat {
 public:
  explicit Mcap(const std::vector<LogColumn>& columns)
      : LogFormat(columns), topics_(topics_of(columns)) {}

  [[nodiscard]] std::string head(long long /*rows*/) const override {
    std::string bytes(magic), header;
    append_text("", header);  // no profile
    append_text(std::string("cdcr ") + version, header);
    append_record(Kind::header, header, bytes);
    for (std::size_t k = 0; k < topics_.size(); ++k) append_channel(k, bytes);
    return bytes;
  }

  void append(const ConstVectorRef& row, long long number, std::string& bytes) const override {
    const auto time = static_cast<std::uint64_t>(std::llround(std::fmax(0.0, 1e9 * row[0])));
    for (std::size_t k = 0; k < topics_.size(); ++k) {
      std::string content;
      append_bytes(static_cast<std::uint16_t>(k + 1), content);
      append_bytes(static_cast<std::uint32_t>(number), content);
      append_bytes(time, content);  // when it was logged, and published
      append_bytes(time, content);
      char before = '{';
      for (const Index i : topics_[k].columns) {
        content += before + ('"' + name(i)) + "\":";
        if (std::isfinite(row[i])) {
          append_number(row[i], content);
        } else {
          content += "null";  // JSON has no others
        }
        before = ',';
      }
      append_record(Kind::message, content + '}', bytes);
    }
  }

  [[nodiscard]] std::string end() const override {
    std::string bytes;
    append_record(Kind::data_end, std::string(4, '\0'), bytes);  // without a checksum
    append_record(Kind::footer, std::string(20, '\0'), bytes);   // without a summary
    return bytes.append(magic);
  }

 private:
  [[nodiscard]] const std::string& name(Index column) const {
    return columns()[static_cast<std::size_t>(column)].name;
  }

  void append_channel(std::size_t k, std::string& bytes) const {
    const auto id = static_cast<std::uint16_t>(k + 1);
    const std::string topic = topics_[k].name;
    const std::string title = "cdcr." + topic;
    std::string text = R"({"type":"object","title":")" + title + R"(","properties":)";
    char before = '{';
    for (const Index i : topics_[k].columns) {
      const std::string& unit = columns()[static_cast<std::size_t>(i)].unit;
      text += before + ('"' + name(i)) + R"(":{"type":"number","description":"[)" + unit + R"(]"})";
      before = ',';
    }
    std::string schema, channel;
    append_bytes(id, schema);
    append_text(title, schema);
    append_text("jsonschema", schema);
    append_text(text + "}}", schema);
    append_record(Kind::schema, schema, bytes);
    append_bytes(id, channel);
    append_bytes(id, channel);  // of its schema
    append_text("/" + topic, channel);
    append_text("json", channel);
    append_text("", channel);  // nothing else about it
    append_record(Kind::channel, channel, bytes);
  }

  std::vector<Topic> topics_;
};

}  // namespace

LogFormatPtr mcap_format(const std::vector<LogColumn>& columns) {
  return std::make_unique<Mcap>(columns);
}

}  // namespace cdcr::detail
