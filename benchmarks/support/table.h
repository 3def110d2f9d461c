/// \file
/// What a benchmark prints: a table to read, one in Markdown, or JSON lines.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace portalens::benchmarks {

enum class Style { text, markdown, json };

/// A word, a number, or nothing.
using Cell = std::variant<std::monostate, std::string, double>;

struct Column {
  std::string title;
  std::string key;            ///< in JSON; empty: it is left out there
  std::string format = "{}";  ///< of its numbers
  double shown_times = 1.0;   ///< what a number is multiplied by, but in JSON: 100 for percent
};

class Table {
 public:
  Table(std::string title, std::vector<Column> columns)
      : title_(std::move(title)), columns_(std::move(columns)) {}

  /// @param benchmark  what JSON calls the row
  /// @pre as many cells as there are columns
  void add(std::string benchmark, std::vector<Cell> cells);

  void print(Style style) const;

 private:
  struct Row {
    std::string benchmark;
    std::vector<Cell> cells;
  };

  void print_json() const;

  std::string title_;
  std::vector<Column> columns_;
  std::vector<Row> rows_;
};

/// A line beside the tables; left out where the output is JSON.
void remark(Style style, const std::string& text);

}  // namespace portalens::benchmarks
