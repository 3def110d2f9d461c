#include "support/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace portalens::benchmarks {
namespace {

std::string shown(const Cell& cell, const Column& column) {
  if (const auto* word = std::get_if<std::string>(&cell)) return *word;
  if (const auto* number = std::get_if<double>(&cell))
    return fmt::format(fmt::runtime(column.format), *number * column.shown_times);
  return "";
}

nlohmann::json as_json(const Cell& cell) {
  if (const auto* word = std::get_if<std::string>(&cell)) return *word;
  if (const auto* number = std::get_if<double>(&cell); number && std::isfinite(*number))
    return *number;
  return nullptr;
}

}  // namespace

void Table::add(std::string benchmark, std::vector<Cell> cells) {
  assert(cells.size() == columns_.size());
  rows_.push_back({std::move(benchmark), std::move(cells)});
}

void Table::print(Style style) const {
  if (style == Style::json) {
    print_json();
  } else {
    std::vector<std::vector<std::string>> lines(1);
    for (const Column& column : columns_) lines[0].push_back(column.title);
    for (const Row& row : rows_) {
      lines.emplace_back();
      for (std::size_t i = 0; i < columns_.size(); ++i)
        lines.back().push_back(shown(row.cells[i], columns_[i]));
    }
    std::vector<std::size_t> widths(columns_.size());
    for (const auto& line : lines)
      for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
    fmt::print("{}{}\n", style == Style::markdown ? "### " : "", title_);
    if (style == Style::markdown) fmt::print("\n");
    for (std::size_t n = 0; n < lines.size(); ++n) {
      std::string text = style == Style::markdown ? "|" : " ";
      for (std::size_t i = 0; i < lines[n].size(); ++i)
        text += style == Style::markdown ? fmt::format(" {} |", lines[n][i])
                : i == 0                 ? fmt::format(" {:<{}}", lines[n][i], widths[i])
                                         : fmt::format("  {:>{}}", lines[n][i], widths[i]);
      fmt::print("{}\n", text);
      if (n == 0 && style == Style::markdown) {
        text = "|";
        for (std::size_t i = 0; i < columns_.size(); ++i) text += "---|";
        fmt::print("{}\n", text);
      }
    }
    fmt::print("\n");
  }
  std::fflush(stdout);
}

void Table::print_json() const {
  for (const Row& row : rows_) {
    nlohmann::ordered_json line{{"benchmark", row.benchmark}};
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (!columns_[i].key.empty()) line[columns_[i].key] = as_json(row.cells[i]);
    fmt::print("{}\n", line.dump());
  }
}

void remark(Style style, const std::string& text) {
  if (style != Style::json) fmt::print("{}\n\n", text);
}

}  // namespace portalens::benchmarks
