// Logs of loops: rows from one thread to another, what stands in them, what is dropped, files.
#include <doctest/doctest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "cdcr/cdcr.hpp"
#include "support/allocations.hpp"
#include "support/controlled_robots.hpp"
#include "support/throws.hpp"

namespace cdcr::test {
namespace {

using Bits = std::vector<double>;

std::vector<LogColumn> two() {
  return {{"t", "s", ""}, {"square", "s^2", "powers"}};
}

/// The numbers of columns in a row, from that of a name on.
VectorXd values(const Log& log, const VectorXd& row, const std::string& name, Index count) {
  for (std::size_t i = 0; i < log.columns().size(); ++i) {
    if (log.columns()[i].name == name) return row.segment(static_cast<Index>(i), count);
  }
  FAIL("no column ", name);
  return {};
}

/// A file that is gone after the test.
class Scratch {
 public:
  explicit Scratch(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("cdcr_loop_log_" + name)) {}
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { std::filesystem::remove(path_); }
  [[nodiscard]] std::string path() const { return path_.string(); }
  [[nodiscard]] std::string text() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  std::filesystem::path path_;
};

TEST_SUITE_BEGIN("loop_log");

TEST_CASE("rows come out in their order, and what finds no room is counted") {
  Log log(two(), 3);
  CHECK(log.capacity() == 4);
  Eigen::Vector2d row;
  CHECK_FALSE(log.pop(row));
  for (int round = 0; round < 5; ++round) {
    for (int k = 0; k < 7; ++k) CHECK(log.push(Eigen::Vector2d(k, k * k)) == (k < 4));
    CHECK(log.dropped() == 3 * (round + 1));
    for (int k = 0; k < 4; ++k) {
      REQUIRE(log.pop(row));
      CHECK(row == Eigen::Vector2d(k, k * k));
    }
    CHECK_FALSE(log.pop(row));
  }
  CHECK_FALSE(log.push(Vector3d::Zero()));
  CHECK(log.dropped() == 15);
}

constexpr int count = 20000;  // rows that two threads hand over

TEST_CASE("between two threads no row is torn, lost or told twice") {
  Log log(two(), 8);
  std::thread other([&log] {
    for (int k = 0; k < count; ++k) log.push(Eigen::Vector2d(k, 1.0 * k * k));
    while (!log.push(Eigen::Vector2d(count, -1.0))) std::this_thread::yield();
  });
  Eigen::Vector2d row(-1.0, 0.0);
  long told = 0, torn = 0;
  for (double last = -1.0; row[1] != -1.0;) {
    if (!log.pop(row)) {
      std::this_thread::yield();
      continue;
    }
    if (row[1] != -1.0 && (row[0] <= last || row[1] != row[0] * row[0])) ++torn;
    last = row[0];
    ++told;
  }
  other.join();
  CHECK(torn == 0);
  CHECK(told >= 8);
  // The last row was tried until there was room.
  CHECK(told + log.dropped() >= count + 1);
  CHECK(told <= count + 1);
}

TEST_CASE("a row is what run tells of the step, bit for bit") {
  for (const NamedRobot& sample : controlled_robots()) {
    CAPTURE(sample.name);
    const Model model(sample.robot);
    const Index d = model.num_coordinates(), c = model.num_cables();
    ComputedTorque controller(model);
    controller.set_reference(model.rest() + VectorXd::Constant(d, 0.01));
    LoopOptions how;
    how.substeps = model.has_rods() ? 40 : 1;
    how.actuators.assign(1, {0.0, 0.0, 0.005, 1e3, 0.0, 100.0, {}});
    how.sensors.resize(2);
    how.sensors[0].noise = 1e-4;
    how.sensors[1].kind = Sensor::Kind::tensions;
    Loop loop(model, controller, how);
    const VectorXd& start = model.rest();
    const VectorXd still = VectorXd::Zero(d);
    loop.reset(start, still, 1.0);
    const LoopRun told = run(loop, 0.03);
    LoopLog log(loop);
    loop.set_log(&log);
    loop.reset(start, still, 1.0);
    VectorXd row(static_cast<Index>(log.columns().size()));
    for (Index k = 0; k < 30; ++k) {
      CAPTURE(k);
      REQUIRE(loop.step() == Status::ok);
      REQUIRE(log.pop(row));
      CHECK(row[0] == told.t[k]);
      CHECK(values(log, row, "q1_x", d) == told.q.row(k).transpose());
      CHECK(values(log, row, "qd1_x", d) == told.qd.row(k).transpose());
      CHECK(values(log, row, "tension1", c) == told.tension.row(k).transpose());
      CHECK(values(log, row, "asked1", c) == told.asked.row(k).transpose());
      CHECK(values(log, row, "tip_x", 3) == tip(model, told.q.row(k).transpose()).p);
      CHECK(values(log, row, "sensor1_1", d) == told.told[0].row(k).transpose());
      CHECK(values(log, row, "sensor2_1", c) == told.told[1].row(k).transpose());
      CHECK(values(log, row, "told_q1_x", d) == told.told_q.row(k).transpose());
      CHECK(values(log, row, "told_qd1_x", d) == told.told_qd.row(k).transpose());
      CHECK(values(log, row, "reference_q1_x", d) == told.reference.row(k).transpose());
      CHECK(told.reference.row(k).transpose() == controller.setpoint().value);
      CHECK(values(log, row, "status", 1)[0] == 0.0);
      const double update = values(log, row, "duration", 1)[0];
      CHECK(update > 0.0);
      CHECK(values(log, row, "step_duration", 1)[0] >= update);
    }
    CHECK(log.dropped() == 0);
    const bool lengths = model.cables()[0].length_driven();
    if (lengths) CHECK(values(log, row, "command1", c) == told.command.row(29).transpose());
    loop.set_log(nullptr);
    REQUIRE(loop.step() == Status::ok);
    CHECK_FALSE(log.pop(row));
  }
}

TEST_CASE("an estimator and a reference of the tip stand in it, and how a step failed") {
  const Model model(upright(1));
  TaskSpace controller(model);
  LoopOptions how;
  KalmanOptions known;
  known.sensors.resize(1);
  known.sensors[0].noise = 1e-4;
  known.force_at = Place{0, 1.0};
  how.sensors = known.sensors;
  ExtendedKalman filter(model, known);
  Loop loop(model, controller, how, &filter);
  LoopLog log(loop);
  loop.set_log(&log);
  loop.reset(Eigen::Vector2d(0.1, 0.0), Eigen::Vector2d(0.0, 0.0));
  REQUIRE(loop.step() == Status::ok);
  VectorXd row(static_cast<Index>(log.columns().size()));
  REQUIRE(log.pop(row));
  CHECK(values(log, row, "reference_tip_x", 3) == controller.setpoint().value);
  CHECK(values(log, row, "innovation", 1)[0] == filter.diagnostics().innovation);
  CHECK(values(log, row, "measured", 1)[0] == 2.0);
  VectorXd force(3), deviations(3);
  filter.write_values(force, deviations);
  CHECK(values(log, row, "estimated_force_x", 3) == force);
  CHECK(values(log, row, "deviation_force_x", 3) == deviations);

  class Pushing final : public Controller {
   public:
    void reset() noexcept override {}
    Status update(double /*t*/, const ConstVectorRef& /*q*/, const ConstVectorRef& /*qd*/,
                  VectorRef command) noexcept override {
      command.setConstant(-1.0);
      return Status::ok;
    }
    [[nodiscard]] double period() const noexcept override { return 1e-3; }
    [[nodiscard]] Index num_coordinates() const noexcept override { return any_size; }
    [[nodiscard]] Index num_cables() const noexcept override { return any_size; }
  } pushing;
  Loop failing(model, pushing);
  CHECK_THROWS_SENTENCE(failing.set_log(&log),
                        "the log was made for another loop: its columns are not those of this one");
  LoopLog last(failing);
  failing.set_log(&last);
  failing.reset(Eigen::Vector2d(0.1, 0.0), Eigen::Vector2d(0.0, 0.0));
  for (int k = 0; k < 3; ++k) REQUIRE(failing.step() == Status::invalid_tension);
  row.resize(static_cast<Index>(last.columns().size()));
  REQUIRE(last.pop(row));
  CHECK(values(last, row, "status", 1)[0] == static_cast<double>(Status::invalid_tension));
  CHECK_FALSE(last.pop(row));  // what has ended takes no steps
}

TEST_CASE("a loop with a log allocates nothing, with room and without") {
  const Model model(upright(3));
  ComputedTorque controller(model);
  Loop loop(model, controller);
  LoopLog log(loop, 128);
  loop.set_log(&log);
  loop.reset(model.rest(), VectorXd::Zero(6));
  Status status = Status::ok;
  CHECK(allocations_of([&] {
          for (int k = 0; k < 200; ++k) status = loop.step();
        }) == 0);
  CHECK(status == Status::ok);
  CHECK(log.dropped() == 200 - 128);
}

TEST_CASE("files keep every bit, and can be read while they grow") {
  Log log(two(), 64);
  const Bits numbers{0.5, 0.1, 1.0 / 3.0, 5e-324, -1.7976931348623157e308, 3.0};
  for (const double number : numbers) log.push(Eigen::Vector2d(0.25, number));
  const Scratch csv("a.csv"), npy("a.npy"), mcap("a.mcap");
  LogFile text(csv.path(), two()), records(npy.path(), two()), messages(mcap.path(), two());
  CHECK(text.take(log) == 6);
  CHECK(text.take(log) == 0);
  text.flush();
  std::string read = csv.text();
  CHECK(read.rfind("t [s],square [s^2]\n0.25,0.5\n", 0) == 0);
  for (std::size_t at = read.find('\n'), k = 0; k < numbers.size(); ++k) {
    at = read.find(',', at) + 1;
    CHECK(std::strtod(read.c_str() + at, nullptr) == numbers[k]);
  }
  const std::size_t head = npy.text().size();
  CHECK(head % 64 == 0);
  const std::size_t whole = mcap.text().size();
  records.write(Eigen::Vector2d(1.0, 2.0));
  records.flush();
  CHECK(npy.text().size() == head + 16);
  CHECK(npy.text().find("'shape': (1 ") != std::string::npos);
  messages.write(Eigen::Vector2d(1.0, 2.0));
  messages.flush();
  messages.write(Eigen::Vector2d(1.0, std::nan("")));
  messages.flush();
  read = mcap.text();
  CHECK(read.size() > whole);
  CHECK(read.find("{\"square\":2}") != std::string::npos);
  CHECK(read.find("{\"square\":null}") != std::string::npos);
  CHECK(read.substr(read.size() - 8) == read.substr(0, 8));
}

TEST_CASE("a writer writes all rows from a thread of its own") {
  const Scratch csv("b.csv"), gone("no_such_folder/b.csv");
  Log log(two(), 4096);
  {
    LogWriter writer(log, csv.path(), 1e-3);
    for (int k = 0; k < 1000; ++k) log.push(Eigen::Vector2d(k, k));
    writer.close();
    writer.close();
  }
  const std::string read = csv.text();
  CHECK(std::count(read.begin(), read.end(), '\n') == 1001);
  CHECK(read.find("\n999,999\n") != std::string::npos);
  CHECK(log.dropped() == 0);

  CHECK_THROWS_SENTENCE(LogWriter(log, csv.path(), 0.0),
                        "period of a log's writer must be > 0 s and finite, got 0");
  const std::string refused =
      gone.path() + " cannot be written: is there such a folder, and is it yours?";
  CHECK_THROWS_SENTENCE(LogFile(gone.path(), two()), refused.c_str());
  CHECK_THROWS_SENTENCE(LogFile("log.txt", two()),
                        "the file of a log must end in .csv, .npy or .mcap, got log.txt");
  CHECK_THROWS_SENTENCE(Log({}), "the first column of a log must be t in s, got none");
  CHECK_THROWS_SENTENCE(Log({{"q", "rad", ""}}),
                        "the first column of a log must be t in s, got q in rad");
  CHECK_THROWS_SENTENCE(Log(two(), 0), "capacity of a log must be 1 to 16777216 rows, got 0");
  CHECK_THROWS_SENTENCE(Log({two()[0], {"a,b", "m", "x"}}),
                        "names in a log must be of ASCII letters without comma, quotes and "
                        "backslash, got a,b");
  LogFile file(csv.path(), two());
  CHECK_THROWS_SENTENCE(file.write(Vector3d::Zero()), "a row of this log has 2 values, got 3");
}

TEST_CASE("a writer that can write no more says so at the end, and the loop goes on") {
  const Scratch csv("c.csv");
  Log log(two(), 1024);
  LogWriter writer(log, csv.path(), 1e-3);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit little{1024, before.rlim_max};
  const auto usual = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &little);
  for (int k = 0; k < 1000; ++k) CHECK(log.push(Eigen::Vector2d(k, 1.0 / 3.0)));
  const std::string trouble = csv.path() + " cannot be written: is the disk full?";
  CHECK_THROWS_WITH_AS(writer.close(), trouble.c_str(), std::runtime_error);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, usual);
}

TEST_SUITE_END();

}  // namespace
}  // namespace cdcr::test
