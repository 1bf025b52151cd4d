#pragma once

#include <string>

#include "cdcr/integrator.hpp"
#include "cdcr/robot.hpp"

namespace cdcr::fmu {

/// What an FMU is made from: file setup.txt among its resources, as python/cdcr/export writes it.
struct Setup {
  std::string token;  ///< of modelDescription.xml
  Robot robot;
  Method method = Method::dopri5;  ///< within a communication step
  Options options = tight();

 private:
  /// Each communication step begins anew, and what beginnings lose adds up.
  static Options tight() {
    Options options;
    options.rtol = 1e-12;
    options.atol = 1e-14;
    return options;
  }
};

/// Throws std::invalid_argument with a sentence that names the line it cannot read.
[[nodiscard]] Setup read_setup(const std::string& path);

}  // namespace cdcr::fmu
