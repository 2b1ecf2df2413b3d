#include "core/config/config.hpp"

#include <yaml-cpp/yaml.h>

#include "core/config/reader.hpp"

namespace coop::config {

struct Document::Impl {
  YAML::Node root{YAML::NodeType::Map};
  Source source;
};

Document::Document() : impl_(std::make_shared<Impl>()) {
  impl_->source.name = "defaults";
}

Document Document::load(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw Error(path.string() + ": no such configuration file");
  }
  Document document;
  document.impl_->source.name = path.string();
  try {
    document.impl_->root = YAML::LoadFile(path.string());
  } catch (const YAML::Exception& problem) {
    throw Error(path.string() + ":" + std::to_string(problem.mark.line + 1) +
                ": no valid YAML: " + problem.msg);
  }
  if (document.impl_->root.IsNull()) document.impl_->root = YAML::Node(YAML::NodeType::Map);
  if (!document.impl_->root.IsMap()) throw Error(path.string() + ":1: expected a YAML mapping");
  return document;
}

Document Document::parse(std::string_view yaml, std::string name) {
  Document document;
  document.impl_->source.name = std::move(name);
  try {
    document.impl_->root = YAML::Load(std::string(yaml));
  } catch (const YAML::Exception& problem) {
    throw Error(document.impl_->source.name + ":" + std::to_string(problem.mark.line + 1) +
                ": no valid YAML: " + problem.msg);
  }
  if (document.impl_->root.IsNull()) document.impl_->root = YAML::Node(YAML::NodeType::Map);
  if (!document.impl_->root.IsMap()) {
    throw Error(document.impl_->source.name + ":1: expected a YAML mapping");
  }
  return document;
}

void Document::set(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  const std::string key(assignment.substr(0, equals));
  if (equals == std::string_view::npos || key.empty()) {
    throw Error("--set " + std::string(assignment) + ": expected key=value");
  }
  YAML::Node value;
  try {
    value = YAML::Load(std::string(assignment.substr(equals + 1)));
  } catch (const YAML::Exception& problem) {
    throw Error("--set " + key + ": no valid YAML value: " + problem.msg);
  }
  YAML::Node node = impl_->root;
  std::size_t begin = 0;
  for (std::size_t dot = key.find('.'); dot != std::string::npos; dot = key.find('.', begin)) {
    const std::string part = key.substr(begin, dot - begin);
    if (node[part].IsDefined() && !node[part].IsNull() && !node[part].IsMap()) {
      throw Error("--set " + key + ": '" + key.substr(0, dot) + "' is no mapping");
    }
    node.reset(node[part]);
    impl_->source.overridden.insert(key.substr(0, dot));
    begin = dot + 1;
  }
  node[key.substr(begin)] = value;
  impl_->source.overridden.insert(key);
}

std::string Document::text() const {
  YAML::Emitter out;
  out << impl_->root;
  return std::string(out.c_str()) + "\n";
}

std::unique_ptr<Fields> Document::make_reader() const {
  return std::make_unique<Reader>(impl_->root, impl_->source);
}

void Document::finish(Fields& reader) const {
  static_cast<Reader&>(reader).finish();
}

}  // namespace coop::config
