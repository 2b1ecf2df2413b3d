#pragma once
#include <functional>
#include <iostream>
#include <memory>
#include <string>

#include "core/config/config.hpp"
#include "runtime/node.hpp"

namespace coop::runtime {

/// The type-free part of a component for run_program().
struct Program {
  std::string name;
  std::string description;
  /// Throws where the configuration is bad.
  std::function<void(const config::Document&)> check;
  std::function<std::string(const config::Document&)> print_config;
  std::function<std::string()> print_table;
  std::function<std::shared_ptr<void>(Node&, const config::Document&)> start;
};

int run_program(int argc, const char* const* argv, const Program& program);

/// Runs `Component` as a program: options, configuration, DDS, clock, signals, heartbeat. Component
/// has a `Config` with describe(), a constructor (Node&, const Config&) and, where the
/// configuration names files that must be there, a `static void check(const Config&)`. Bad
/// configuration and failing constructors end in one line on stderr and exit code 1.
template <class Component>
int run(int argc, const char* const* argv, const std::string& name,
        const std::string& description) {
  using Config = typename Component::Config;
  Program program;
  program.name = name;
  program.description = description;
  program.check = [](const config::Document& document) {
    const auto config = document.read<Config>();
    if constexpr (requires { Component::check(config); }) Component::check(config);
  };
  program.print_config = [](const config::Document& document) {
    return config::to_yaml(document.read<Config>());
  };
  program.print_table = [] { return config::to_markdown_table<Config>(); };
  program.start = [](Node& node, const config::Document& document) -> std::shared_ptr<void> {
    return std::make_shared<Component>(node, document.read<Config>());
  };
  return run_program(argc, argv, program);
}

}  // namespace coop::runtime
