#include "capture/node/play_config.hpp"

#include <stdexcept>

#include "core/config/error.hpp"

namespace coop::capture {

void PlayConfig::describe(config::Fields& fields) {
  fields.text("file", file, {.help = "capture (MCAP), or a folder of the parts of one"});
  fields.number("rate", rate,
                {.unit = "s/s",
                 .help = "seconds of the capture a second; 0: as fast as possible",
                 .min = 0,
                 .max = 1000});
  fields.flag("loop", loop, {.help = "begin anew at the end"});
  fields.number("start", start, {.unit = "s", .help = "into the capture", .min = 0});
  fields.number("duration", duration,
                {.unit = "s", .help = "of the capture; 0: to its end", .min = 0});
  fields.texts("topics", topics, {.help = "patterns of topics to play; none: all"});
  fields.texts("exclude", exclude, {.help = "patterns of topics to leave out"});
  fields.texts(
      "without", without,
      {.help = "components whose messages are left out; in lockstep also all that take part"});
  fields.texts("remap", remap, {.help = "FROM:=TO: the topic is published under another name"});
  fields.flag("clock", clock, {.help = "publish /clock with the capture's time"});
  fields.number("clock_period", clock_period,
                {.unit = "s", .help = "between two clock messages", .min = 0.0001, .max = 1});
  fields.number("wait", wait,
                {.unit = "s",
                 .help = "for readers that are there to be matched, and for those of `readers`",
                 .min = 0,
                 .max = 3600});
  fields.texts("readers", readers, {.help = "topics that somebody must read before it begins"});
  fields.flag("paused", paused, {.help = "wait for the space bar"});
  fields.flag("keyboard", keyboard, {.help = "space: pause, n: next message, q: end"});
}

void PlayConfig::validate() const {
  try {
    selection().validate();
  } catch (const std::invalid_argument& problem) {
    throw config::Error(problem.what());
  }
  if (paused && !keyboard) throw config::Error("paused: nobody could go on without keyboard");
}

PlaySelection PlayConfig::selection() const {
  PlaySelection selection{.topics = {topics, exclude},
                          .without = without,
                          .remap = remap,
                          .start = start,
                          .duration = duration};
  if (clock) selection.topics.exclude.emplace_back("/clock");
  return selection;
}

}  // namespace coop::capture
