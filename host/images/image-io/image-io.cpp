// libtessera-image-io.so: images to and from files, by OpenImageIO.
#include "host/images/image-io/image-io.h"

#include <OpenImageIO/hash.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

namespace tessera::images {
namespace {

using OIIO::TypeDesc;

constexpr std::string_view kPrefix = "tessera:";  // of the names of what an image depends on
constexpr std::size_t kBandBytes = std::size_t{16} << 20;
constexpr std::uint32_t kBandRows = 64;  // a multiple of the 16 rows that are compressed together

// OpenImageIO's messages may run over several lines.
std::string firstLine(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "OpenImageIO does not say why" : line;
}

std::size_t pixelBytes(const Header& header) {
  std::size_t bytes = 0;
  for (const Channel& channel : header.channels) bytes += channel.bytes;
  return bytes;
}

// `act(begin, end, bytes)` for the image from top to bottom, until it gives a text.
template <typename Act>
std::string eachBand(const Header& header, Act&& act) {
  const std::size_t rowBytes = header.width * pixelBytes(header);
  const std::uint32_t rows = rowBytes * kBandRows > kBandBytes ? 16 : kBandRows;
  for (std::uint32_t begin = 0; begin < header.height; begin += rows) {
    const std::uint32_t end = std::min(header.height, begin + rows);
    if (std::string error = act(begin, end, (end - begin) * rowBytes); !error.empty()) return error;
  }
  return {};
}

OIIO::ImageSpec specOf(Format format, const Header& header) {
  const bool exr = format == Format::kExr;
  OIIO::ImageSpec spec(static_cast<int>(header.width), static_cast<int>(header.height),
                       static_cast<int>(header.channels.size()), exr ? TypeDesc::FLOAT : TypeDesc::UINT8);
  for (std::size_t c = 0; exr && c < header.channels.size(); ++c) {
    spec.channelnames[c] = header.channels[c].name;
    spec.channelformats.push_back(header.channels[c].type == "uint" ? TypeDesc::UINT32 : TypeDesc::FLOAT);
  }
  if (exr) spec.attribute("compression", "zip");
  // Else OpenImageIO writes the time; of a type that OpenEXR has not, it writes none.
  const std::uint8_t none = 0;
  if (exr) spec.attribute("DateTime", TypeDesc::UINT8, &none);
  if (!exr) spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);  // as PNG has it: nothing is multiplied or divided by alpha
  for (const auto& [name, text] : header.text) spec.attribute(std::string(kPrefix) + name, text);
  return spec;
}

class ExrReader : public Reader {
 public:
  explicit ExrReader(std::unique_ptr<OIIO::ImageInput> in) : in_(std::move(in)) {
    const OIIO::ImageSpec& spec = in_->spec();
    header_.width = static_cast<std::uint32_t>(spec.width);
    header_.height = static_cast<std::uint32_t>(spec.height);
    for (int c = 0; c < spec.nchannels; ++c) {
      const TypeDesc type = spec.channelformat(c);
      header_.channels.push_back({spec.channelnames[static_cast<std::size_t>(c)], type.c_str(), type.size()});
    }
    for (const auto& attribute : spec.extra_attribs) {
      if (attribute.name().string().starts_with(kPrefix) && attribute.type() == OIIO::TypeString)
        header_.text.emplace_back(attribute.name().string().substr(kPrefix.size()), attribute.get_string());
    }
    std::ranges::sort(header_.text);
  }
  const Header& header() const override { return header_; }
  std::string read(std::uint32_t begin, std::uint32_t end, std::byte* pixels) override {
    const OIIO::ImageSpec& spec = in_->spec();
    const int first = spec.y + static_cast<int>(begin), last = spec.y + static_cast<int>(end);
    const bool good = in_->read_scanlines(0, 0, first, last, 0, 0, spec.nchannels, TypeDesc::UNKNOWN, pixels);
    return good ? "" : firstLine(in_->geterror());
  }

 private:
  std::unique_ptr<OIIO::ImageInput> in_;
  Header header_;
};

std::unique_ptr<Reader> openExr(const std::string& file, std::string& error) {
  // By the format's name: OpenImageIO would else try all its other readers on a broken file.
  auto in = OIIO::ImageInput::create("openexr");
  OIIO::ImageSpec spec;
  if (!in || !in->open(file, spec)) {
    error = firstLine(in ? in->geterror() : OIIO::geterror());
    return nullptr;
  }
  return std::make_unique<ExrReader>(std::move(in));
}

using Hashes = std::vector<std::uint64_t>;  // of the bands

std::string writeBands(OIIO::ImageOutput& out, const Header& header, const RowSource& rows, Hashes& hashes) {
  std::vector<std::byte> pixels;
  const std::string error = eachBand(header, [&](std::uint32_t begin, std::uint32_t end, std::size_t bytes) {
    pixels.resize(bytes);
    rows(begin, end, pixels.data());
    hashes.push_back(OIIO::xxhash::XXH64(pixels.data(), bytes));
    const bool good =
        out.write_scanlines(static_cast<int>(begin), static_cast<int>(end), 0, TypeDesc::UNKNOWN, pixels.data());
    return good ? "" : firstLine(out.geterror());
  });
  return !error.empty() ? error : out.close() ? "" : firstLine(out.geterror());
}

// Nobody reads a .png's last chunk to get its pixels. Text: what is wrong with it.
std::string faultOfEnd(const std::string& file) {
  constexpr std::string_view end("\0\0\0\0IEND\xae\x42\x60\x82", 12);
  std::string found(end.size(), '\0');
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::strerror(errno);
  in.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  return in.read(found.data(), static_cast<std::streamsize>(found.size())) && found == end ? "" : "its end is missing";
}

// OpenImageIO does not report what fails when a file's last bytes are flushed, so that the file is read again.
std::string readBack(const std::string& file, Format format, const Header& header, const Hashes& hashes) {
  const auto in = OIIO::ImageInput::create(format == Format::kExr ? "openexr" : "png");
  OIIO::ImageSpec spec;
  if (!in || !in->open(file, spec, specOf(format, header))) return firstLine(in ? in->geterror() : OIIO::geterror());
  if (spec.width != static_cast<int>(header.width) || spec.height != static_cast<int>(header.height) ||
      spec.nchannels != static_cast<int>(header.channels.size()))
    return "its header reads back otherwise";
  if (format == Format::kPng)
    if (std::string fault = faultOfEnd(file); !fault.empty()) return fault;
  // The file may have its channels in another order.
  std::vector<std::size_t> offsets;
  for (int c = 0; c < spec.nchannels; ++c) {
    const int at = format == Format::kExr ? spec.channelindex(header.channels[static_cast<std::size_t>(c)].name) : c;
    if (at < 0) return "its header reads back otherwise";
    offsets.push_back(spec.pixel_bytes(0, at, true));
  }
  std::vector<std::byte> found, pixels;
  auto hash = hashes.begin();
  return eachBand(header, [&](std::uint32_t begin, std::uint32_t end, std::size_t bytes) {
    found.resize(bytes);
    pixels.resize(bytes);
    const int first = static_cast<int>(begin), last = static_cast<int>(end);
    if (!in->read_scanlines(0, 0, first, last, 0, 0, spec.nchannels, TypeDesc::UNKNOWN, found.data()))
      return firstLine(in->geterror());
    const std::size_t stride = pixelBytes(header);
    std::size_t to = 0;
    for (std::size_t c = 0; c < offsets.size(); to += header.channels[c++].bytes)
      for (std::size_t at = 0; at < bytes; at += stride)
        std::copy_n(&found[at + offsets[c]], header.channels[c].bytes, &pixels[at + to]);
    return OIIO::xxhash::XXH64(pixels.data(), bytes) == *hash++ ? "" : std::string("its pixels read back otherwise");
  });
}

std::string write(const std::string& file, Format format, const Header& header, const RowSource& rows) {
  const auto out = OIIO::ImageOutput::create(format == Format::kExr ? "openexr" : "png");
  if (!out || !out->open(file, specOf(format, header))) return firstLine(out ? out->geterror() : OIIO::geterror());
  Hashes hashes;
  std::string error = writeBands(*out, header, rows, hashes);
  return error.empty() ? readBack(file, format, header, hashes) : error;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const Module* tesseraImageIo() {
  OIIO::attribute("debug", 0);  // Debian's build prints what it makes of each attribute
  static const Module module{TESSERA_MODULE_VERSION, write, openExr};
  return &module;
}

}  // namespace tessera::images
