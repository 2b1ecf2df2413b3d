#include "global_planner/reeds_shepp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/vehicle/ackermann.hpp"

namespace coop::global_planner {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2.0;
constexpr double kSlack = 1e-9;

/// Goal seen from the start, in units of the turning radius.
struct Goal {
  double x, y, phi;
};

/// Solution of a formula: the free lengths, in radii and radians. t comes first on the path, v
/// last.
struct Lengths {
  bool valid = false;
  double t = 0.0, u = 0.0, v = 0.0;
};

Lengths solution(bool valid, double t, double u, double v) {
  return {valid, t, u, v};
}
bool forward(double length) {
  return length >= -kSlack;
}
bool backward(double length) {
  return length <= kSlack;
}

// The formulas are written for words that begin with a left turn forwards; xi and eta are the
// paper's abbreviations.

/// 8.1: L+ S+ L+
Lengths left_straight_left(const Goal& g) {
  const double xi = g.x - std::sin(g.phi);
  const double eta = g.y - 1.0 + std::cos(g.phi);
  const double t = std::atan2(eta, xi);
  const double v = normalize_angle(g.phi - t);
  return solution(forward(t) && forward(v), t, std::hypot(xi, eta), v);
}

/// 8.2: L+ S+ R+
Lengths left_straight_right(const Goal& g) {
  const double xi = g.x + std::sin(g.phi);
  const double eta = g.y - 1.0 - std::cos(g.phi);
  const double squared = xi * xi + eta * eta;
  if (squared < 4.0) return {};
  const double u = std::sqrt(squared - 4.0);
  const double t = normalize_angle(std::atan2(eta, xi) + std::atan2(2.0, u));
  const double v = normalize_angle(t - g.phi);
  return solution(forward(t) && forward(v), t, u, v);
}

/// 8.3, 8.4: L+ R- L+ and L+ R- L-
Lengths left_right_left(const Goal& g) {
  const double xi = g.x - std::sin(g.phi);
  const double eta = g.y - 1.0 + std::cos(g.phi);
  const double rho = std::hypot(xi, eta);
  if (rho > 4.0) return {};
  const double u = -2.0 * std::asin(rho / 4.0);
  const double t = normalize_angle(std::atan2(eta, xi) + u / 2.0 + std::numbers::pi);
  const double v = normalize_angle(g.phi - t + u);
  return solution(forward(t) && backward(u), t, u, v);
}

/// The angles tau and omega of the words with four arcs.
std::pair<double, double> tau_omega(double u, double v, double xi, double eta, double phi) {
  const double delta = normalize_angle(u - v);
  const double a = std::sin(u) - std::sin(delta);
  const double b = std::cos(u) - std::cos(delta) - 1.0;
  const double angle = std::atan2(eta * a - xi * b, xi * a + eta * b);
  const bool other_side = 2.0 * (std::cos(delta) - std::cos(v) - std::cos(u)) + 3.0 < 0.0;
  const double tau = normalize_angle(other_side ? angle + std::numbers::pi : angle);
  return {tau, normalize_angle(tau - u + v - phi)};
}

/// 8.7: L+ R(u)+ L(u)- R-
Lengths left_right_left_right_cusp(const Goal& g) {
  const double xi = g.x + std::sin(g.phi);
  const double eta = g.y - 1.0 - std::cos(g.phi);
  const double rho = 0.25 * (2.0 + std::hypot(xi, eta));
  if (rho > 1.0) return {};
  const double u = std::acos(rho);
  const auto [t, v] = tau_omega(u, -u, xi, eta, g.phi);
  return solution(forward(t) && backward(v), t, u, v);
}

/// 8.8: L+ R(u)- L(u)- R+
Lengths left_right_left_right_back(const Goal& g) {
  const double xi = g.x + std::sin(g.phi);
  const double eta = g.y - 1.0 - std::cos(g.phi);
  const double rho = (20.0 - xi * xi - eta * eta) / 16.0;
  if (rho < 0.0 || rho > 1.0) return {};
  const double u = -std::acos(rho);
  if (u < -kHalfPi) return {};
  const auto [t, v] = tau_omega(u, u, xi, eta, g.phi);
  return solution(forward(t) && forward(v), t, u, v);
}

/// 8.9: L+ R(pi/2)- S- L-
Lengths left_right_straight_left(const Goal& g) {
  const double xi = g.x - std::sin(g.phi);
  const double eta = g.y - 1.0 + std::cos(g.phi);
  const double rho = std::hypot(xi, eta);
  if (rho < 2.0) return {};
  const double r = std::sqrt(rho * rho - 4.0);
  const double u = 2.0 - r;
  const double t = normalize_angle(std::atan2(eta, xi) + std::atan2(r, -2.0));
  const double v = normalize_angle(g.phi - kHalfPi - t);
  return solution(forward(t) && backward(u) && backward(v), t, u, v);
}

/// 8.10: L+ R(pi/2)- S- R-
Lengths left_right_straight_right(const Goal& g) {
  const double xi = g.x + std::sin(g.phi);
  const double eta = g.y - 1.0 - std::cos(g.phi);
  const double rho = std::hypot(xi, eta);
  if (rho < 2.0) return {};
  const double t = std::atan2(xi, -eta);
  const double u = 2.0 - rho;
  const double v = normalize_angle(t + kHalfPi - g.phi);
  return solution(forward(t) && backward(u) && backward(v), t, u, v);
}

/// 8.11: L+ R(pi/2)- S- L(pi/2)- R+
Lengths left_right_straight_left_right(const Goal& g) {
  const double xi = g.x + std::sin(g.phi);
  const double eta = g.y - 1.0 - std::cos(g.phi);
  const double squared = xi * xi + eta * eta;
  if (squared < 4.0) return {};
  const double u = 4.0 - std::sqrt(squared - 4.0);
  if (u > 0.0) return {};
  const double t =
      normalize_angle(std::atan2((4.0 - u) * xi - 2.0 * eta, -2.0 * xi + (u - 4.0) * eta));
  const double v = normalize_angle(t - g.phi);
  return solution(forward(t) && forward(v), t, u, v);
}

/// Collects the words of one symmetry of the goal: lengths change sign under a time flip, sides
/// under a reflection, the order of the arcs under reversal.
class Collector {
 public:
  Collector(ReedsShepp::Words& words, double radius) : words_(words), radius_(radius) {}

  void set_symmetry(double direction, double side, bool reversed) {
    direction_ = direction;
    side_ = side;
    reversed_ = reversed;
  }

  struct Turn {
    double length;  ///< radii, or radians
    int side;       ///< 1 left, -1 right, 0 straight
  };
  template <std::size_t N>
  void add(const Lengths& lengths, const std::array<Turn, N>& turns) {
    if (!lengths.valid || words_.count == ReedsShepp::kMaxWords) return;
    ArcPath& path = words_.paths[words_.count++];
    path.count = N;
    for (std::size_t i = 0; i < N; ++i) {
      const Turn& turn = turns[reversed_ ? N - 1 - i : i];
      path.arcs[i] = {direction_ * turn.length * radius_, side_ * turn.side / radius_};
    }
  }

 private:
  ReedsShepp::Words& words_;
  double radius_;
  double direction_ = 1.0;
  double side_ = 1.0;
  bool reversed_ = false;
};

/// Words whose reversal is a word of the same family.
void collect_symmetric(const Goal& g, Collector& out) {
  if (const Lengths l = left_straight_left(g); l.valid) {
    out.add<3>(l, {{{l.t, 1}, {l.u, 0}, {l.v, 1}}});
  }
  if (const Lengths l = left_straight_right(g); l.valid) {
    out.add<3>(l, {{{l.t, 1}, {l.u, 0}, {l.v, -1}}});
  }
  if (const Lengths l = left_right_left_right_cusp(g); l.valid) {
    out.add<4>(l, {{{l.t, 1}, {l.u, -1}, {-l.u, 1}, {l.v, -1}}});
  }
  if (const Lengths l = left_right_left_right_back(g); l.valid) {
    out.add<4>(l, {{{l.t, 1}, {l.u, -1}, {l.u, 1}, {l.v, -1}}});
  }
  if (const Lengths l = left_right_straight_left_right(g); l.valid) {
    out.add<5>(l, {{{l.t, 1}, {-kHalfPi, -1}, {l.u, 0}, {-kHalfPi, 1}, {l.v, -1}}});
  }
}

/// Words that have to be tried from both ends.
void collect_asymmetric(const Goal& g, Collector& out) {
  if (const Lengths l = left_right_left(g); l.valid) {
    out.add<3>(l, {{{l.t, 1}, {l.u, -1}, {l.v, 1}}});
  }
  if (const Lengths l = left_right_straight_left(g); l.valid) {
    out.add<4>(l, {{{l.t, 1}, {-kHalfPi, -1}, {l.u, 0}, {l.v, 1}}});
  }
  if (const Lengths l = left_right_straight_right(g); l.valid) {
    out.add<4>(l, {{{l.t, 1}, {-kHalfPi, -1}, {l.u, 0}, {l.v, -1}}});
  }
}

}  // namespace

double ArcPath::length() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += std::abs(arcs[i].length);
  return sum;
}

Pose2 ArcPath::end(Pose2 from) const {
  for (std::size_t i = 0; i < count; ++i) {
    from = vehicle::advance_along_arc(from, arcs[i].length, arcs[i].length * arcs[i].curvature);
  }
  return from;
}

void ReedsShepp::connect(const Pose2& from, const Pose2& to, Words& words) const {
  words.count = 0;
  const Pose2 goal = from.inverse() * to;
  const double x = goal.x / radius_;
  const double y = goal.y / radius_;
  const double c = std::cos(goal.yaw);
  const double s = std::sin(goal.yaw);
  // The same path driven from its end to its start, seen so that it begins at the origin.
  const double reversed_x = x * c + y * s;
  const double reversed_y = x * s - y * c;
  Collector out(words, radius_);
  for (const double direction : {1.0, -1.0}) {
    for (const double side : {1.0, -1.0}) {
      const double phi = direction * side * goal.yaw;
      out.set_symmetry(direction, side, false);
      collect_symmetric({direction * x, side * y, phi}, out);
      collect_asymmetric({direction * x, side * y, phi}, out);
      out.set_symmetry(direction, side, true);
      collect_asymmetric({direction * reversed_x, side * reversed_y, phi}, out);
    }
  }
}

double ReedsShepp::distance(const Pose2& from, const Pose2& to) const {
  Words words;
  connect(from, to, words);
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < words.count; ++i) {
    shortest = std::min(shortest, words.paths[i].length());
  }
  return shortest;
}

}  // namespace coop::global_planner
