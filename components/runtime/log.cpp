#include "runtime/log.hpp"

#include <spdlog/sinks/rotating_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>

namespace coop::runtime {
namespace {

constexpr std::size_t kFileBytes = 8U << 20U;
constexpr std::size_t kFiles = 3;

constexpr const char* name_of(Level level) {
  switch (level) {
    case Level::kDebug:
      return "debug";
    case Level::kInfo:
      return "info";
    case Level::kWarning:
      return "warning";
    case Level::kError:
      return "error";
  }
  return "";
}

std::shared_ptr<spdlog::logger> plain(std::shared_ptr<spdlog::logger> logger) {
  logger->set_pattern("%v");
  logger->flush_on(spdlog::level::trace);
  logger->set_error_handler([](const std::string&) {});
  return logger;
}

}  // namespace

Logger::Logger(std::string component, const Clock& clock, const std::filesystem::path& directory,
               Level level)
    : component_(std::move(component)), clock_(clock), level_(level) {
  console_ = plain(std::make_shared<spdlog::logger>(
      component_, std::make_shared<spdlog::sinks::stdout_sink_mt>()));
  if (directory.empty()) return;
  try {
    file_ = plain(std::make_shared<spdlog::logger>(
        component_, std::make_shared<spdlog::sinks::rotating_file_sink_mt>(
                        (directory / (component_ + ".jsonl")).string(), kFileBytes, kFiles)));
  } catch (const spdlog::spdlog_ex& problem) {
    write(Level::kWarning, std::string("no log file: ") + problem.what());
  }
}

Logger::~Logger() = default;

void Logger::write(Level level, const std::string& text) {
  const double stamp = to_seconds(clock_.now());
  console_->info("{:.3f} {:7} {}: {}", stamp, name_of(level), component_, text);
  if (!file_) return;
  const double wall =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  const nlohmann::ordered_json line{{"stamp", stamp},
                                    {"wall", wall},
                                    {"level", name_of(level)},
                                    {"component", component_},
                                    {"text", text}};
  file_->info(line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

bool Logger::is_due(const std::string& topic, Duration interval) {
  const Time now = clock_.now();
  const auto [entry, is_new] = last_.try_emplace(topic, now);
  if (!is_new && now >= entry->second && now - entry->second < interval) return false;
  entry->second = now;
  return true;
}

}  // namespace coop::runtime
