#include "amcl/amcl.hpp"
#include "core/config/error.hpp"

namespace coop::amcl {

void AmclConfig::describe(config::Fields& fields) {
  fields.number(
      "update_distance", update_distance,
      {.unit = "m", .help = "driven until the next scan is weighed in", .min = 0, .max = 5});
  fields.number(
      "update_angle", update_angle,
      {.unit = "rad", .help = "turned until the next scan is weighed in", .min = 0, .max = 3});
  fields.integer("beams", beams, {.help = "of a scan, at most", .min = 4, .max = 10000});
  fields.number("max_range", max_range,
                {.unit = "m", .help = "longer beams are not used", .min = 0.5, .max = 500});
  fields.integer("min_beams", min_beams,
                 {.help = "fewer usable beams say nothing", .min = 1, .max = 10000});
  fields.number("independent_beams", independent_beams,
                {.help = "so many independent beams a scan is worth", .min = 0.5, .max = 10000});
  fields.number("searching_beams", searching_beams,
                {.help = "the same while the pose is open", .min = 0.5, .max = 10000});
  fields.number("resample_share", resample_share,
                {.help = "resample below this share of effective particles", .min = 0, .max = 1});
  fields.number(
      "localised_stddev", localised_stddev,
      {.unit = "m", .help = "the pose is known from this spread on", .min = 0.01, .max = 10});
  fields.number("lost_stddev", lost_stddev,
                {.unit = "m",
                 .help = "the pose is no longer known from this spread on",
                 .min = 0.01,
                 .max = 20});
  fields.number("localised_share", localised_share,
                {.help = "weight the heaviest cluster must hold", .min = 0, .max = 1});
  fields.number("search_noise", search_noise,
                {.unit = "m, rad",
                 .help = "spread added an update while the pose is not known",
                 .min = 0,
                 .max = 1});
  fields.integer("settle_updates", settle_updates,
                 {.help = "scans weighed in after the pose was found, even if the robot stands",
                  .min = 0,
                  .max = 1000});
  fields.number("searching_share", searching_share,
                {.help = "of the particles drawn anew at each update while the pose is open",
                 .min = 0,
                 .max = 0.9});
  fields.integer("standing_updates", standing_updates,
                 {.help = "scans weighed in while the pose is open and the robot stands",
                  .min = 1,
                  .max = 1000});
  fields.number("standing_beams", standing_beams,
                {.help = "so many independent beams all scans from one place are worth",
                 .min = 0.5,
                 .max = 10000});
  fields.integer("scattered_particles", scattered_particles,
                 {.help = "spread over free space for global localisation", .min = 10, .max = 1e7});
  fields.integer(
      "recovery_candidates", recovery_candidates,
      {.help = "poses tried against a scan to draw recovery particles from", .min = 1, .max = 1e7});
  fields.number("lost_fit", lost_fit,
                {.help = "mean likelihood of the beams below which the pose is wrong; 0: never",
                 .min = 0,
                 .max = 1});
  fields.number("fit_rate", fit_rate,
                {.help = "decay a scan of the fit compared with it", .min = 0.001, .max = 1});
  fields.number(
      "restart_stddev", restart_stddev,
      {.unit = "m", .help = "moved unseen while odometry was restarted", .min = 0, .max = 5});
  fields.number("restart_yaw_stddev", restart_yaw_stddev,
                {.unit = "rad", .help = "the same", .min = 0, .max = 3.2});
  fields.section("motion", motion);
  fields.section("field", field);
  fields.section("kld", kld);
  fields.section("recovery", recovery);
}

void AmclConfig::validate() const {
  kld.validate();
  if (lost_stddev <= localised_stddev) {
    throw config::Error("lost_stddev must be above localised_stddev");
  }
}

}  // namespace coop::amcl
