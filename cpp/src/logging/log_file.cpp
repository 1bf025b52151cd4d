#include <fstream>
#include <stdexcept>

#include "base/arguments.hpp"
#include "cdcr/log.hpp"
#include "logging/log_format.hpp"

namespace cdcr {
namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

detail::LogFormatPtr format_of(const std::string& path, const std::vector<LogColumn>& columns) {
  if (ends_with(path, ".csv")) return detail::csv_format(columns);
  if (ends_with(path, ".npy")) return detail::numpy_format(columns);
  if (ends_with(path, ".mcap")) return detail::mcap_format(columns);
  detail::refuse("the file of a log must end in .csv, .npy or .mcap, got ", path);
}

}  // namespace

struct LogFile::Parts {
  std::string path;
  detail::LogFormatPtr format;
  std::ofstream stream;
  VectorXd row;
  std::string bytes;
  long long rows = 0;

  void put(const std::string& some) {
    stream.write(some.data(), static_cast<std::streamsize>(some.size()));
    if (!stream) throw std::runtime_error(path + " cannot be written: is the disk full?");
  }
};

LogFile::LogFile(const std::string& path, const std::vector<LogColumn>& columns)
    : parts_(std::make_unique<Parts>()) {
  parts_->path = path;
  parts_->format = format_of(path, columns);
  parts_->row.resize(static_cast<Index>(columns.size()));
  parts_->stream.open(path, std::ios::binary | std::ios::trunc);
  detail::require(parts_->stream.is_open(), path,
                  " cannot be written: is there such a folder, and is it yours?");
  parts_->put(parts_->format->head(0));
  flush();
}

LogFile::~LogFile() {
  try {
    flush();
  } catch (const std::exception&) {
    parts_->stream.close();  // a destructor has nobody to tell
  }
}

void LogFile::write(const ConstVectorRef& row) {
  Parts& my = *parts_;
  detail::require(row.size() == my.row.size(), "a row of this log has ", my.row.size(),
                  " values, got ", row.size());
  my.bytes.clear();
  my.format->append(row, my.rows, my.bytes);
  my.put(my.bytes);
  ++my.rows;
}

Index LogFile::take(Log& log) {
  Index taken = 0;
  for (; log.pop(parts_->row); ++taken) write(parts_->row);
  return taken;
}

void LogFile::flush() {
  Parts& my = *parts_;
  const std::streampos here = my.stream.tellp();
  my.stream.seekp(0);
  my.put(my.format->head(my.rows));
  my.stream.seekp(here);
  my.put(my.format->end());
  my.stream.flush();
  my.stream.seekp(here);
  my.put({});
}

}  // namespace cdcr
