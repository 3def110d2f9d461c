#include "app/checkpoint_manager.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <future>
#include <iostream>
#include <system_error>

#include "app/command.h"
#include "core/words.h"
#include "io/files.h"

namespace portalens {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds look_again{20};
/// How long threads may take to come back before what stands is written without them.
constexpr std::chrono::milliseconds patience{1000};

std::string percent_text(double share) {
  return fmt::format("{:.1f} %", std::floor(1000.0 * share) / 10.0);
}

/// What is asked for now, as the checkpoint's own words would be.
Fingerprint whole_fingerprint(const Provenance& provenance, const Assignment& assignment) {
  Fingerprint all = provenance.fingerprint;
  const Fingerprint part = fingerprint_of(assignment);
  all.insert(all.end(), part.begin(), part.end());
  return all;
}

void check_same(const PartialFile& checkpoint, const Provenance& provenance,
                const Assignment& assignment) {
  const PartialHeader& head = checkpoint.head();
  const Location place{std::make_shared<const std::string>(checkpoint.name()), 0};
  Faults faults;
  for (const Difference& one : differences(whole_fingerprint(head.provenance, head.assignment),
                                           whole_fingerprint(provenance, assignment)))
    faults.add(place,
               fmt::format("{} was {}, and is {} now", one.name, in_quotes(one.before),
                           in_quotes(one.now)),
               "make it as it was, or begin anew with --restart in place of --resume");
  faults.raise();
  if (head.assignment.film != assignment.film || head.assignment.samples != assignment.samples)
    throw SceneError({{place, "it contradicts itself", "begin anew with --restart"}});
}

bool lies_there(const fs::path& file) {
  std::error_code error;
  return fs::exists(fs::symlink_status(file, error));
}

/// The exit code of a program that such a signal ended.
int code_of(int signal) { return 128 + signal; }

/// One render, kept.
class CheckpointManager {
 public:
  CheckpointManager(const Exposure& exposure, const Provenance& provenance, const Keeping& keeping)
      : exposure_(exposure), provenance_(provenance), keeping_(keeping) {}

  /// Looks after the work until it is ready.
  /// @return the signal that ended it, or 0
  int attend(const std::future<void>& work, Signals& signals) {
    while (work.wait_for(look_again) != std::future_status::ready) {
      if (const int signal = signals.ended_by()) {
        if (work.wait_for(patience) != std::future_status::ready) leave(signal);
        return signal;
      }
      if (signals.take_look()) attempt([&] { show("goes on"); });
      if (keeping_.seconds && since_checkpoint() > *keeping_.seconds) {
        attempt([&] { keep(keeping_, provenance_, exposure_); });
        last_ = Clock::now();
      }
    }
    return signals.ended_by();
  }

  /// Writes the checkpoint and the partial picture, and says so.
  void show(const char* state) {
    if (!is_kept(keeping_.picture)) return show_share(state);
    const fs::path picture = unfinished(keeping_.picture);
    // The disk takes the one while the other is packed.
    auto written = std::async([&] { keeping_.write_picture(picture, result_of(exposure_)); });
    keep(keeping_, provenance_, exposure_);
    written.get();
    last_ = Clock::now();
    if (keeping_.quiet) return;
    std::cerr << fmt::format("{}: {} is done; what stands is in {}, and {} keeps the work\n", state,
                             percent_text(exposure_.share_done()), picture.string(),
                             checkpoint_of(keeping_.picture).string());
  }

 private:
  void show_share(const char* state) const {
    if (keeping_.quiet) return;
    std::cerr << fmt::format("{}: {} is done; of a picture for standard output nothing is kept\n",
                             state, percent_text(exposure_.share_done()));
  }
  [[nodiscard]] double since_checkpoint() const {
    return std::chrono::duration<double>(Clock::now() - last_).count();
  }

  /// What fails on the path is told, and the render goes on: the disk may have room the next time.
  template <class Work>
  void attempt(const Work& work) {
    try {
      work();
    } catch (const std::exception& error) {
      if (!failed_) std::cerr << "note: the render goes on, but " << error.what() << '\n';
      failed_ = true;
    }
  }

  /// Ends the program past threads that don't come back.
  [[noreturn]] void leave(int signal) {
    int code = code_of(signal);
    try {
      show("interrupted");
    } catch (const std::exception& error) {
      std::cerr << "portalens: " << error.what() << '\n';
      code = exit_work_failed;
    }
    std::cout.flush();
    std::_Exit(code);
  }

  const Exposure& exposure_;
  const Provenance& provenance_;
  const Keeping& keeping_;
  Clock::time_point last_ = Clock::now();
  bool failed_ = false;
};

}  // namespace

bool is_kept(const fs::path& picture) { return picture != standard_stream; }

fs::path checkpoint_of(const fs::path& picture) {
  fs::path name = picture;
  name += ".checkpoint";
  return name;
}

fs::path unfinished(const fs::path& picture) {
  fs::path name = picture.stem();
  name += ".unfinished";
  name += picture.extension() == partial_suffix ? ".exr" : picture.extension();
  return picture.parent_path() / name;
}

std::unique_ptr<Exposure> begun_exposure(const fs::path& checkpoint, Found found,
                                         const Provenance& provenance,
                                         const Assignment& assignment) {
  const Location place{std::make_shared<const std::string>(checkpoint.string()), 0};
  const bool stands = lies_there(checkpoint);
  if (found == Found::refuse && stands)
    throw SceneError({{place, "the checkpoint of an earlier render lies there",
                       "go on with it with --resume, or throw it away with --restart"}});
  if (found == Found::resume && !stands)
    throw SceneError({{place, "there is no checkpoint to resume from",
                       "leave --resume out to begin; a render that is interrupted leaves one, and "
                       "with --checkpoint SECONDS one is written on the way"}});
  if (found != Found::resume) return std::make_unique<Exposure>(assignment);
  const PartialFile file(checkpoint);
  check_same(file, provenance, assignment);
  return file.exposure();
}

void keep(const Keeping& keeping, const Provenance& provenance, const Exposure& exposure) {
  if (!is_kept(keeping.picture)) return;
  replace_file(checkpoint_of(keeping.picture), encoded_partial(provenance, exposure));
}

void keep_if_possible(const Keeping& keeping, const Provenance& provenance,
                      const Exposure& exposure) noexcept {
  if (!is_kept(keeping.picture)) return;
  try {
    keep(keeping, provenance, exposure);
    std::cerr << fmt::format("note: {} keeps the work; --resume goes on with it\n",
                             checkpoint_of(keeping.picture).string());
  } catch (...) {  // the first failure is the one to be told
  }
}

std::optional<int> run_kept(const World& world, Exposure& exposure, const RenderOptions& options,
                            const Provenance& provenance, const Keeping& keeping, Signals& signals,
                            Progress* progress) {
  CheckpointManager checkpoint_manager(exposure, provenance, keeping);
  auto work =
      std::async(std::launch::async, [&] { expose(world, exposure, options, progress, &signals); });
  const int signal = checkpoint_manager.attend(work, signals);
  try {
    work.get();
  } catch (...) {
    keep_if_possible(keeping, provenance, exposure);
    throw;
  }
  if (signal == 0 || exposure.complete()) return std::nullopt;
  checkpoint_manager.show("interrupted");
  return code_of(signal);
}

}  // namespace portalens
