#include "core/markup.hpp"

namespace coop {
namespace {

constexpr std::string_view kStyle =
    "body{font:16px/1.45 system-ui,sans-serif;max-width:1200px;margin:2em auto;padding:0 "
    "1em;color:#222}"
    "img{max-width:100%;border:1px solid #bbb}svg{max-width:100%;height:auto}"
    "table{border-collapse:collapse;margin:1em 0}"
    "th,td{border:1px solid #ccc;padding:.3em .7em;text-align:left}th{background:#f3f3f3}"
    ".good{color:#176b17;font-weight:bold}.bad{color:#b01010;font-weight:bold}";

}  // namespace

std::string escape_markup(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string html_table(const std::vector<std::string>& headings,
                       const std::vector<std::vector<std::string>>& rows) {
  const auto row = [](const std::vector<std::string>& fields, std::string_view tag) {
    std::string out = "<tr>";
    for (const std::string& field : fields) {
      out += "<" + std::string(tag) + ">" + escape_markup(field) + "</" + std::string(tag) + ">";
    }
    return out + "</tr>\n";
  };
  std::string out = "<table>\n" + row(headings, "th");
  for (const auto& fields : rows) out += row(fields, "td");
  return out + "</table>\n";
}

std::string html_page(std::string_view title, std::string_view body) {
  std::string page = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>";
  page += escape_markup(title);
  page += "</title><style>";
  page += kStyle;
  page += "</style></head><body>\n";
  page += body;
  page += "</body></html>\n";
  return page;
}

}  // namespace coop
