#include "portalens/error.h"

#include <utility>

#include "api/access.h"
#include "core/words.h"
#include "photon/photon.h"

namespace portalens::api {
namespace {

constexpr int max_threads = 1024;

std::string joined(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) text += (text.empty() ? "" : "\n") + to_string(fault);
  return text;
}

}  // namespace

std::string to_string(const Fault& fault) {
  std::string text = fault.file;
  if (fault.line > 0) text += ":" + std::to_string(fault.line);
  if (!text.empty()) text += ": ";
  text += fault.problem;
  if (!fault.remedy.empty()) text += "; " + fault.remedy;
  return harmless(std::move(text));
}

Error::Error(Cause cause, std::vector<Fault> faults)
    : std::runtime_error(joined(faults)), cause_(cause), faults_(std::move(faults)) {}
Error::~Error() = default;

const char* to_string(Fate fate) noexcept {
  return fate_names[static_cast<std::size_t>(fate)].data();
}

std::vector<Fault> outward(const std::vector<portalens::Fault>& faults) {
  std::vector<Fault> result;
  for (const portalens::Fault& fault : faults)
    result.push_back({fault.where.file ? *fault.where.file : std::string(), fault.where.line,
                      fault.problem, fault.remedy});
  return result;
}

Error asked(std::string problem, std::string remedy) {
  return {Cause::asked, {{"", 0, std::move(problem), std::move(remedy)}}};
}

void check_threads(int threads) {
  if (threads < 0 || threads > max_threads)
    throw asked(std::to_string(threads) + " threads",
                "0 to " + std::to_string(max_threads) + " are possible; 0: as many as there are");
}

}  // namespace portalens::api
