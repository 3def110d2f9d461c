#include "world/table_kinds.h"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/choice.h"
#include "core/words.h"
#include "geometry/shape.h"
#include "io/vocabulary.h"

namespace portalens {
namespace {

/// What is written `[[kind]]`.
std::vector<std::string> list_kinds() {
  std::vector<std::string> kinds{"material", "light"};
  for (const std::string_view shape : Choice<Shape>::names()) kinds.emplace_back(shape);
  kinds.insert(kinds.end(), {"mass", "portal"});
  return kinds;
}

class TableJudge {
 public:
  explicit TableJudge(Faults& faults) : faults_(faults), lists_(list_kinds()) {
    tables_.insert(tables_.end(), lists_.begin(), lists_.end());
  }

  void judge(const Misplaced& one) {
    if (!is_list(one.name)) return refuse(one);
    const bool element = one.form == Misplaced::Form::element;
    faults_.add(one.where,
                one.name + (element ? " contains what is not a table" : " is not a list of tables"),
                "write [[" + one.name + "]] for each " + one.name + ", and its keys below it");
  }

  void judge(const Table& object) {
    if (!is_list(object.kind)) refuse({Misplaced::Form::table, object.kind, object.where});
  }

 private:
  [[nodiscard]] bool is_list(const std::string& name) const {
    return std::find(lists_.begin(), lists_.end(), name) != lists_.end();
  }

  void refuse(const Misplaced& one) {
    if (!refused_.insert(one.name).second) return;
    const bool table = one.form == Misplaced::Form::table;
    faults_.add(one.where, (table ? "unknown table " : "unknown key ") + in_quotes(one.name),
                table ? suggestion_or_list(one.name, tables_)
                      : "every key stands in a table; known tables are " + listed(tables_));
  }

  Faults& faults_;
  std::vector<std::string> lists_;
  std::vector<std::string> tables_ = sections_known();
  std::set<std::string> refused_;
};

}  // namespace

void refuse_unknown_tables(const Scene& scene, Faults& faults) {
  TableJudge judge(faults);
  for (const Misplaced& one : scene.misplaced) judge.judge(one);
  for (const Table& object : scene.objects) judge.judge(object);
}

}  // namespace portalens
