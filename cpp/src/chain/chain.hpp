#pragma once

#include <array>
#include <type_traits>
#include <vector>

#include "cdcr/robot.hpp"
#include "section/constant_curvature.hpp"
#include "section/rod.hpp"

// The robot of n sections as a chain of flexible bodies, each carried by the tip of the one before
// (cpp/several-sections.md eqs. (23) to (34)). The recursions of this room are templates on the
// kind of section; what they ask of it is in section/section_state.hpp.

namespace cdcr::detail {

/// What the chain ends in: a rigid body at the tip, expressed in the tip frame.
struct Payload {
  double mass = 0.0;
  Vector3d position = Vector3d::Zero();
  Matrix3d inertia = Matrix3d::Zero();  // about the tip

  [[nodiscard]] bool has_inertia() const noexcept { return mass != 0.0 || !inertia.isZero(0.0); }
};

/// Whether two sections have the same inertia: then they share a table.
[[nodiscard]] bool moves_alike(const Section& a, const Section& b);

struct Chain;
/// The sections of a robot, and its chain, whose tables another may share; or none.
struct KnownTables {
  const std::vector<Section>* sections = nullptr;
  const Chain* chain = nullptr;
};

/// A robot made ready for the recursions.
struct Chain {
  explicit Chain(const Robot& robot, const KnownTables& known = {});

  [[nodiscard]] Index num_sections() const noexcept { return static_cast<Index>(sections.size()); }
  [[nodiscard]] Index num_coordinates() const noexcept { return first.back(); }
  /// Whether its sections are rods, all of them; otherwise they are of constant curvature.
  [[nodiscard]] bool has_rods() const noexcept { return sections.front().rod != nullptr; }

  std::vector<SectionParameters> sections;
  std::vector<Index> first;  // coordinate of each section, and past the last
  Payload payload;
  Matrix3d root;     // orientation of the first section
  Vector3d gravity;  // in the base frame
};

template <class S>
[[nodiscard]] FrameState<S> root_of(const Chain& chain) {
  return {chain.root.col(0).cast<S>(), chain.root.col(1).cast<S>(), chain.root.col(2).cast<S>(),
          Vector3<S>::Zero()};
}

/// Of the state of one section [bytes].
template <class S>
constexpr std::size_t largest_section_on_stack() {
  return 256 * sizeof(S);
}

/// All sections of a chain in one state, by one pass from base to tip for q and one for qd. States
/// of large sections are on the heap: made for one chain, they allocate nothing later on.
template <class Section>
struct ChainState {
  using S = typename Section::Scalar;
  using Sections = std::conditional_t<(sizeof(Section) > largest_section_on_stack<S>()),
                                      std::vector<Section>, std::array<Section, max_sections>>;

  ChainState() = default;
  explicit ChainState(const Chain& chain) { reserve(chain); }

  void update_position(const Chain& chain, const S* q) {
    reserve(chain);
    tip = root_of<S>(chain);
    for (Index i = 0; i < chain.num_sections(); ++i) {
      sections[i].update_position(chain.sections[i], tip, q + chain.first[i]);
      tip = sections[i].end();
    }
  }
  void update_velocity(const Chain& chain, const S* qd) {
    tip.omega.setZero();
    for (Index i = 0; i < chain.num_sections(); ++i) turn(chain, i, qd);
  }
  /// Both in one pass.
  void update(const Chain& chain, const S* q, const S* qd) {
    reserve(chain);
    tip = root_of<S>(chain);
    for (Index i = 0; i < chain.num_sections(); ++i) {
      const Vector3<S> omega = tip.omega;
      sections[i].update_position(chain.sections[i], tip, q + chain.first[i]);
      tip = sections[i].end();
      tip.omega = omega;
      turn(chain, i, qd);
    }
  }

  Sections sections;
  FrameState<S> tip;

 private:
  void reserve(const Chain& chain) {
    if constexpr (std::is_same_v<Sections, std::vector<Section>>) {
      if (sections.size() < chain.sections.size()) sections.resize(chain.sections.size());
    }
  }
  /// Velocity of section i, with tip.omega that of its base and then of its tip.
  void turn(const Chain& chain, Index i, const S* qd) {
    Section& section = sections[i];
    if (i == 0) {
      section.template update_velocity<false>(chain.sections[i], tip.omega, qd + chain.first[i]);
    } else {
      section.template update_velocity<true>(chain.sections[i], tip.omega, qd + chain.first[i]);
    }
    tip.omega = section.turning_rate();
  }
};

template <class S>
using ArcChainState = ChainState<ConstantCurvature<S>>;
template <class S>
using RodChainState = ChainState<Rod<S>>;

}  // namespace cdcr::detail
