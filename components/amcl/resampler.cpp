#include "amcl/resampler.hpp"

#include <algorithm>
#include <cmath>

#include "core/config/error.hpp"

namespace coop::amcl {
namespace {

/// Draws indices in proportion to weights, at fractions that step by the golden ratio.
class Comb {
 public:
  Comb(const ParticleSet& particles, std::vector<double>& cumulative, RandomStream& random)
      : cumulative_(cumulative), fraction_(random.uniform()) {
    cumulative_.resize(particles.size());
    double total = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      total += static_cast<double>(particles.weight[i]);
      cumulative_[i] = total;
    }
  }

  [[nodiscard]] std::size_t next() {
    constexpr double kGolden = 0.6180339887498949;
    const auto at =
        std::upper_bound(cumulative_.begin(), cumulative_.end(), fraction_ * cumulative_.back());
    fraction_ += kGolden;
    if (fraction_ >= 1.0) fraction_ -= 1.0;
    const auto index = static_cast<std::size_t>(at - cumulative_.begin());
    return std::min(index, cumulative_.size() - 1);  // rounding may step over the end
  }

 private:
  std::vector<double>& cumulative_;
  double fraction_;
};

}  // namespace

void KldConfig::describe(config::Fields& fields) {
  fields.integer("min_particles", min_particles, {.help = "never fewer", .min = 10, .max = 1e6});
  fields.integer(
      "max_particles", max_particles,
      {.help = "never more; reached only while the pose is open", .min = 10, .max = 1e6});
  fields.number("error", error,
                {.help = "bound on the Kullback-Leibler distance", .min = 0.001, .max = 1});
  fields.number("quantile", quantile,
                {.help = "standard normal quantile of keeping the bound", .min = 0, .max = 5});
  fields.number("bin_size", bin_size,
                {.unit = "m", .help = "bin of the sample count", .min = 0.02, .max = 5});
  fields.number("yaw_bin_size", yaw_bin_size,
                {.unit = "rad", .help = "bin of the sample count", .min = 0.02, .max = 3.2});
}

void KldConfig::validate() const {
  if (min_particles > max_particles) {
    throw config::Error("min_particles is above max_particles");
  }
}

std::size_t kld_bound(std::size_t bins, double error, double quantile) {
  if (bins <= 1) return 1;
  const double freedom = static_cast<double>(bins - 1);
  const double a = 2.0 / (9.0 * freedom);
  const double root = 1.0 - a + std::sqrt(a) * quantile;
  return static_cast<std::size_t>(std::ceil(freedom / (2.0 * error) * root * root * root));
}

Resampler::Resampler(const KldConfig& config)
    : config_(config),
      histogram_(config.bin_size, config.yaw_bin_size,
                 static_cast<std::size_t>(config.max_particles)) {
  cumulative_.reserve(static_cast<std::size_t>(config.max_particles));
}

void Resampler::resample(const ParticleSet& from, double fresh_share, const ParticleSet& fresh,
                         RandomStream& random, ParticleSet& to) {
  Comb posterior(from, cumulative_, random);
  Comb replacement(fresh, fresh_cumulative_, random);
  if (fresh.empty()) fresh_share = 0.0;
  to.clear();
  histogram_.clear();
  const auto least = static_cast<std::size_t>(config_.min_particles);
  const auto most = static_cast<std::size_t>(config_.max_particles);
  std::size_t needed = least;
  while (to.size() < std::min(std::max(needed, least), most)) {
    if (fresh_share > 0.0 && random.uniform() < fresh_share) {
      to.push_back(fresh.pose(replacement.next()), 1.0F);
      continue;
    }
    const Pose2 pose = from.pose(posterior.next());
    to.push_back(pose, 1.0F);
    const std::size_t bins_before = histogram_.bin_count();
    histogram_.add(pose.x, pose.y, pose.yaw, 1.0);
    if (histogram_.bin_count() > bins_before) {
      needed = kld_bound(histogram_.bin_count(), config_.error, config_.quantile);
    }
  }
  std::fill(to.weight.begin(), to.weight.end(), 1.0F / static_cast<float>(to.size()));
}

}  // namespace coop::amcl
