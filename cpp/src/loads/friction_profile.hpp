#pragma once

#include <cmath>

// What a cable that rubs passes on of its tension, cpp/friction.md eqs. (105) to (111), on any
// scalar, packs of doubles too.

namespace cdcr::detail {

/// Share of the full friction up to which a cable that sticks springs back all the way.
inline constexpr double elastic_share = 0.5;
/// What a deflection loses of the way slid, where friction is beyond full; and so at most.
inline constexpr double greatest_loss = 2.0;

/// a where it is so, else b: of each lane of a pack.
template <class S>
[[nodiscard]] S choose(bool so, const S& a, const S& b) {
  return so ? a : b;
}

/// g(h) of eq. (110): what is lost of the way at a share h of the full friction.
template <class S>
[[nodiscard]] S lost_share(const S& h) {
  const S t = (h - elastic_share) * (1.0 / (1.0 - elastic_share)), beyond = 2.0 * t - 1.0;
  const S lost =
      choose(t < S(1.0), S(t * t), choose(beyond < S(greatest_loss), beyond, S(greatest_loss)));
  return choose(t > S(0.0), lost, S(0.0));
}

/// What a tension loses on its way through the turns of sections, where the cable is pulled in, or
/// gains where it is paid out, over the tension where it enters: at the end of the way, and in the
/// mean of its last section. Eqs. (105) and (106), as differences from 1, so that little turn keeps
/// its digits.
template <class S>
struct CapstanFactors {
  S lost, mean_lost, gained, mean_gained;

  CapstanFactors() = default;  // not set: there are as many as sections at most
  CapstanFactors(const S& lost_, const S& mean_lost_, const S& gained_, const S& mean_gained_)
      : lost(lost_), mean_lost(mean_lost_), gained(gained_), mean_gained(mean_gained_) {}
  [[nodiscard]] static CapstanFactors free() { return {S(0.0), S(0.0), S(0.0), S(0.0)}; }
  /// Through one section, by z of eq. (106).
  explicit CapstanFactors(const S& z) {
    using std::exp;
    if (z < 1e-3) {
      mean_lost = z * (0.5 - z * (1.0 / 6.0 - z * (1.0 / 24.0 - z * (1.0 / 120.0))));
      mean_gained = z * (0.5 + z * (1.0 / 6.0 + z * (1.0 / 24.0 + z * (1.0 / 120.0))));
      lost = z * (1.0 - mean_lost);
      gained = z * (1.0 + mean_gained);
    } else {
      const S passes = exp(S(-z)), of_z = 1.0 / z;
      lost = 1.0 - passes;
      gained = lost / passes;
      mean_lost = 1.0 - lost * of_z;
      mean_gained = gained * of_z - 1.0;
    }
  }

  /// This section after a way through others.
  [[nodiscard]] CapstanFactors after(const CapstanFactors& way) const {
    const S passes = 1.0 - way.lost, grows = 1.0 + way.gained;
    return {way.lost + passes * lost, way.lost + passes * mean_lost, way.gained + grows * gained,
            way.gained + grows * mean_gained};
  }

  /// How much the mean of one section falls with its own turn, over how much with one before it.
  [[nodiscard]] S own_share(const S& z, bool in) const {
    if (z < 1e-3) return in ? S(0.5 - z / 12.0) : S(0.5 + z / 12.0);
    return in ? S((1.0 - (1.0 - lost) / (1.0 - mean_lost)) / z)
              : S(((1.0 + gained) / (1.0 + mean_gained) - 1.0) / z);
  }
};

/// What sections miss of a tension over the friction, c_k of eq. (107), by what they lose and gain.
template <class S>
struct Shares {
  S at_entry, lost, gained;

  [[nodiscard]] S of(const S& all, const S& losses, const S& gains) const {
    return at_entry * all + lost * losses + gained * gains;
  }
};

/// The mean tensions of a cable in its sections, at full sliding either way and at a friction in
/// between, eqs. (105) to (108).
template <class S>
class FrictionProfile {
 public:
  /// Tension F at the drive, Coulomb friction at the entry, e^-s of the sheath, and what is lost
  /// from there to the cable's end. With a `least` friction, shares go to zero where there is next
  /// to none, and so does what is slid.
  FrictionProfile(const S& F, const S& entry, const S& sheath_decay, const CapstanFactors<S>& way,
                  const S& least = S(0.0))
      : F_(F) {
    const S past = F - entry;
    in_ = choose(past > S(0.0), past, S(0.0)) * sheath_decay;
    out_ = (F + entry) / sheath_decay;
    most_in_ = F - in_ + in_ * way.lost + least;
    most_out_ = out_ - F + out_ * way.gained + least;
    of_most_in_ = inverse(most_in_);
    of_most_out_ = inverse(most_out_);
  }

  /// Full friction where the cable is pulled in, and where it is paid out [N].
  [[nodiscard]] const S& most_in() const { return most_in_; }
  [[nodiscard]] const S& most_out() const { return most_out_; }

  /// One over these, or 0 where there is none.
  [[nodiscard]] const S& of_most_in() const { return of_most_in_; }
  [[nodiscard]] const S& of_most_out() const { return of_most_out_; }

  /// Sets the friction f, within the full ones.
  void set_friction(const S& f) {
    friction_ = f;
    // 1 and 0, or those shares of each that the friction is between them.
    const S half = 0.5 * f * choose(f > S(0.0), of_most_in_, of_most_out_);
    const S share_in = choose(most_out_ > S(0.0), S(0.5 + half), S(1.0)),
            share_out = choose(most_in_ > S(0.0), S(0.5 - half), S(1.0));
    const S of_in = share_in * of_most_in_, of_out = share_out * of_most_out_;
    shares_ = {of_in * (F_ - in_) + of_out * (out_ - F_), of_in * in_, of_out * out_};
  }
  [[nodiscard]] const S& friction() const { return friction_; }
  [[nodiscard]] const Shares<S>& shares() const { return shares_; }
  /// c_k of eq. (107): what a section misses of the tension, over the friction.
  [[nodiscard]] S share(const CapstanFactors<S>& way) const {
    return shares_.of(S(1.0), way.mean_lost, way.mean_gained);
  }
  /// Mean tension in a section [N].
  [[nodiscard]] S mean(const CapstanFactors<S>& way) const { return F_ - friction_ * share(way); }
  /// Tension at the cable's end [N].
  [[nodiscard]] S end() const { return F_ - friction_; }

 private:
  [[nodiscard]] static S inverse(const S& most) {
    return choose(most > S(0.0), S(1.0 / choose(most > S(0.0), most, S(1.0))), S(0.0));
  }

  S F_, in_, out_;  // at the drive, and past the entry
  S most_in_, most_out_, of_most_in_, of_most_out_;
  S friction_{0.0};
  Shares<S> shares_{S(0.0), S(0.0), S(0.0)};
};

/// Rate of a deflection w at a speed u, where k w is the friction that its spring asks for.
template <class S>
[[nodiscard]] S deflection_rate(const S& spring, const S& u, const FrictionProfile<S>& profile) {
  const auto in = spring > S(0.0);
  const S most = choose(in, profile.most_in(), profile.most_out()),
          of_most = choose(in, profile.of_most_in(), profile.of_most_out()),
          asked = choose(in, spring, S(-spring));
  const S lost =
      choose(asked < S(greatest_loss * most), lost_share(S(asked * of_most)), S(greatest_loss));
  return choose(spring * u > S(0.0), S(u * (1.0 - lost)), u);
}

/// Friction within what is possible.
template <class S>
[[nodiscard]] S limited(const S& spring, const S& most_in, const S& most_out) {
  const S not_more = choose(spring > most_in, most_in, spring);
  return choose(not_more < S(-most_out), S(-most_out), not_more);
}

}  // namespace cdcr::detail
