#pragma once

// Everything of target cdcr::cdcr. cdcr/cvode.hpp belongs to cdcr::cvode.
#include "cdcr/allocation.hpp"
#include "cdcr/coordinates.hpp"
#include "cdcr/dynamics.hpp"
#include "cdcr/integrator.hpp"
#include "cdcr/kinematics.hpp"
#include "cdcr/linearization.hpp"
#include "cdcr/model.hpp"
#include "cdcr/robot.hpp"
#include "cdcr/simulate.hpp"
#include "cdcr/simulator.hpp"
#include "cdcr/statics.hpp"
#include "cdcr/status.hpp"
#include "cdcr/tension_input.hpp"
#include "cdcr/version.hpp"
