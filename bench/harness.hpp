#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "cdcr/version.hpp"

namespace cdcr::bench {

/// Makes the compiler believe that the value is read, and all memory with it.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "r"(&value) : "memory");
}

/// Processor time of this thread [s]: unlike the clock's, it leaves out when others had the core.
inline double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What one row measures and how. A sample is the time of one block divided by its calls.
struct Plan {
  std::string name;
  std::string unit = "ns";  ///< ns, us or ms
  long calls = 1000;        ///< in one block, from one saved state
  long blocks = 2000;
  double deadline = 0.0;  ///< in that unit; 0: none
};

/// Runs what the command line asks for and prints one JSON line for each row.
class Harness {
 public:
  Harness(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const bool has_value = i + 1 < arguments.size();
      if (arguments[i] == "--quick") {
        share_ = 0.1;
      } else if (arguments[i] == "--only" && has_value) {
        only_ = arguments[++i];
      } else if (arguments[i] == "--count" && has_value) {
        count_ = std::atol(arguments[++i].c_str());
      } else {
        std::cerr << "usage: " << argv[0] << " [--quick] [--only NAME] [--count N]\n"
                  << "  --quick      a tenth of the samples\n"
                  << "  --only NAME  this row alone\n"
                  << "  --count N    make N calls and measure nothing (for a profiler)\n";
        std::exit(arguments[i] == "--help" ? 0 : 2);
      }
    }
  }

  [[nodiscard]] bool wants(const std::string& name) const { return only_.empty() || only_ == name; }

  /// Each block: restart(), untimed, then `calls` times call(i). `extra` ends up in the row.
  template <class Restart, class Call>
  void run(const Plan& plan, Restart&& restart, Call&& call, const std::string& extra = "") const {
    if (!wants(plan.name)) return;
    if (count_ >= 0) {
      restart();
      for (long i = 0; i < count_; ++i) call(i);
      return;
    }
    const long blocks = std::max(10L, std::lround(share_ * static_cast<double>(plan.blocks)));
    const double scale = plan.unit == "ns" ? 1e9 : plan.unit == "us" ? 1e6 : 1e3;
    const double per_call = scale / static_cast<double>(plan.calls);
    const bool real_time = plan.deadline > 0.0;  // reading the processor's clock would disturb it
    std::vector<double> samples, own;
    for (long block = -blocks / 10 - 1; block < blocks; ++block) {  // below zero: warm-up
      restart();
      const double before = real_time ? 0.0 : processor_time();
      const auto start = std::chrono::steady_clock::now();
      for (long i = 0; i < plan.calls; ++i) call(i);
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
      if (block < 0) continue;
      samples.push_back(per_call * taken.count());
      if (!real_time) own.push_back(per_call * (processor_time() - before));
    }
    print(plan, samples, own, extra);
  }

 private:
  static double quantile(const std::vector<double>& sorted, double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }

  static void print(const Plan& plan, std::vector<double> samples, std::vector<double> own,
                    const std::string& extra) {
    std::sort(samples.begin(), samples.end());
    std::sort(own.begin(), own.end());
    std::cout << R"({"name": ")" << plan.name << R"(", "unit": ")" << plan.unit << '"';
    std::cout << std::setprecision(5);
    for (const auto& [name, share] :
         {std::pair("min", 0.0), std::pair("p50", 0.5), std::pair("p95", 0.95),
          std::pair("p99", 0.99), std::pair("p99.9", 0.999), std::pair("max", 1.0)}) {
      std::cout << R"(, ")" << name << R"(": )" << quantile(samples, share);
    }
    if (!own.empty()) std::cout << R"(, "own": )" << quantile(own, 0.5);
    std::cout << R"(, "count": )" << samples.size() << R"(, "calls_per_block": )" << plan.calls;
    if (plan.deadline > 0.0) {
      const auto met = std::upper_bound(samples.begin(), samples.end(), plan.deadline);
      std::cout << R"(, "deadline": )" << plan.deadline << R"(, "missed": )" << samples.end() - met;
    }
    std::cout << extra << R"(, "version": ")" << version << R"(", "commit": ")" CDCR_BENCH_COMMIT
              << R"(", "compiler": ")" CDCR_BENCH_COMPILER R"(", "flags": ")" CDCR_BENCH_FLAGS
              << R"(", "cpu": ")" << cpu() << "\"}\n";
  }

  static std::string cpu() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
      if (line.rfind("model name", 0) == 0) return line.substr(line.find(": ") + 2);
    }
    return "unknown";
  }

  double share_ = 1.0;
  std::string only_;
  long count_ = -1;
};

}  // namespace cdcr::bench
