#include "io/exr_file.h"

#include <Iex.h>
#include <ImathBox.h>
#include <ImathMatrix.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMatrixAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <thread>
#include <tuple>

#include "io/exr_matrix.h"
#include "io/image_claim.h"

namespace portalens {
namespace {

/// The bytes of a file. What lies before its first or behind its last byte, as a broken file may
/// say, is not there.
class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(std::string_view bytes) : IStream("the picture"), bytes_(bytes) {}

  bool read(char to[], int count) override {
    const std::size_t left = at_ < bytes_.size() ? bytes_.size() - at_ : 0;
    if (count < 0 || static_cast<std::size_t>(count) > left)
      throw Iex::InputExc("it ends too early");
    std::memcpy(to, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t place) override { at_ = place; }
  void clear() override {}

 private:
  std::string_view bytes_;
  std::uint64_t at_ = 0;
};

class MemoryOutput : public Imf::OStream {
 public:
  explicit MemoryOutput(std::vector<unsigned char>& bytes) : OStream("a picture"), bytes_(bytes) {}

  void write(const char from[], int count) override {
    const auto end = static_cast<std::size_t>(at_) + static_cast<std::size_t>(count);
    if (bytes_.size() < end) bytes_.resize(end);
    std::memcpy(bytes_.data() + at_, from, static_cast<std::size_t>(count));
    at_ = end;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t place) override { at_ = place; }

 private:
  std::vector<unsigned char>& bytes_;
  std::uint64_t at_ = 0;
};

PixelWindow window_of(const Imath::Box2i& box) {
  return {box.min.x, box.min.y, box.max.x - box.min.x + 1, box.max.y - box.min.y + 1};
}

/// What stands before the last dot: `diffuse` of `diffuse.R`.
std::string_view layer_of(std::string_view channel) {
  const std::size_t dot = channel.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : channel.substr(0, dot);
}

bool comes_before(const std::string& a, const std::string& b) {
  const auto rank = [](std::string_view channel) {
    constexpr std::string_view colors = "RGBA";
    const std::string_view layer = layer_of(channel);
    const std::string_view name = layer.empty() ? channel : channel.substr(layer.size() + 1);
    const std::size_t color = name.size() == 1 ? colors.find(name[0]) : std::string_view::npos;
    return std::tuple(layer, std::min(color, colors.size()), name);
  };
  return rank(a) < rank(b);
}

/// The threads that pack; those of one picture at a time.
int packing_threads() {
#ifdef PORTALENS_STD_THREADS
  return 0;  // the thread sanitizer does not see into the library's own pool
#else
  static const int threads = [] {
    const int count = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    Imf::setGlobalThreadCount(count);
    return count;
  }();
  return threads;
#endif
}

}  // namespace

struct ExrFile::Open {
  explicit Open(std::string_view bytes)
      : stream(std::make_unique<MemoryInput>(bytes)), file(*stream, 0) {}
  [[nodiscard]] const Imf::Header& header() const { return file.header(0); }

  std::unique_ptr<Imf::IStream> stream;
  Imf::MultiPartInputFile file;
};

ExrFile::ExrFile(std::string_view bytes) : open_(std::make_unique<Open>(bytes)) {
  const Imf::Header& header = open_->header();
  if (header.hasType() && Imf::isDeepData(header.type()))
    throw Refusal{"holds no flat picture", "save it as an ordinary picture"};
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
      throw Refusal{"has a channel of lower resolution than others", "save it without such"};
    channels_.emplace_back(channel.name());
  }
  std::sort(channels_.begin(), channels_.end(), comes_before);
}

ExrFile::~ExrFile() = default;

PixelWindow ExrFile::data() const { return window_of(open_->header().dataWindow()); }
PixelWindow ExrFile::display() const { return window_of(open_->header().displayWindow()); }

void ExrFile::read(const std::vector<Target>& targets) {
  const Imath::Box2i& window = open_->header().dataWindow();
  const std::size_t width = static_cast<std::size_t>(window.max.x - window.min.x) + 1;
  Imf::FrameBuffer buffer;
  for (const Target& target : targets)
    buffer.insert(target.channel,
                  Imf::Slice::Make(Imf::FLOAT, target.first, window, sizeof(float) * target.step,
                                   sizeof(float) * target.step * width));
  Imf::InputPart part(open_->file, 0);
  part.setFrameBuffer(buffer);
  part.readPixels(window.min.y, window.max.y);
}

std::vector<unsigned char> pack_exr(int width, int height, const std::vector<ChannelView>& channels,
                                    const Metadata& metadata, Packing packing) {
  Imf::Header header(width, height);
  header.compression() = packing == Packing::small ? Imf::ZIP_COMPRESSION : Imf::RLE_COMPRESSION;
  for (const auto& [key, value] : metadata) {
    const auto numbers = key == matrix_entry ? matrix_in(value) : std::nullopt;
    if (!numbers) {
      header.insert(key, Imf::StringAttribute(value));
      continue;
    }
    Imath::M44f matrix;
    std::copy(numbers->begin(), numbers->end(), &matrix[0][0]);
    header.insert(key, Imf::M44fAttribute(matrix));
  }
  Imf::FrameBuffer buffer;
  for (const ChannelView& channel : channels) {
    header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
    const std::size_t step = sizeof(float) * channel.step;
    // It is only read from.
    buffer.insert(channel.name,
                  Imf::Slice::Make(Imf::FLOAT, channel.values.data(), header.dataWindow(), step,
                                   step * static_cast<std::size_t>(width)));
  }
  std::vector<unsigned char> bytes;
  {
    MemoryOutput stream(bytes);
    Imf::OutputFile file(stream, header, packing_threads());
    file.setFrameBuffer(buffer);
    file.writePixels(height);
  }
  return bytes;
}

}  // namespace portalens
