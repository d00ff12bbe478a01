#include "io/vdb_archive.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>

#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/stream.hpp>

namespace lascaux {
namespace {

/// Opens the reader of io::File to streams.
class Reader : public openvdb::io::Archive {
 public:
  explicit Reader(std::istream& stream) : stream_(stream) {
    readHeader(stream_);
    openvdb::io::setStreamMetadataPtr(stream_, tags_, /*transfer=*/false);
    openvdb::io::setVersion(stream_, libraryVersion(), fileVersion());
    openvdb::io::setDataCompression(stream_, compression());
  }

  VdbContents Read(const std::function<bool(const VdbEntry&)>& wants) {
    VdbContents contents;
    contents.metadata.readMeta(stream_);
    const int count = readGridCount(stream_);
    for (int i = 0; i < count; ++i) {
      openvdb::io::GridDescriptor descriptor;
      const openvdb::GridBase::Ptr grid = descriptor.read(stream_);
      VdbEntry entry{descriptor.gridName(), grid->valueType(), grid};
      const bool wanted = wants(entry) && !descriptor.isInstance();
      // Without offsets a grid's end is known only when it has been read.
      if (wanted || !inputHasGridOffsets()) readGrid(grid, descriptor, stream_);
      if (inputHasGridOffsets()) descriptor.seekToEnd(stream_);
      if (!wanted) entry.grid.reset();
      contents.entries.push_back(std::move(entry));
    }
    return contents;
  }

 private:
  std::istream& stream_;
  /// The stream points to it and does not keep it.
  openvdb::io::StreamMetadata::Ptr tags_ = std::make_shared<openvdb::io::StreamMetadata>();
};

}  // namespace

VdbContents ReadVdbContents(std::string_view bytes,
                            const std::function<bool(const VdbEntry&)>& wants) {
  openvdb::initialize();
  boost::iostreams::stream<boost::iostreams::array_source> stream(bytes.data(), bytes.size());
  stream.exceptions(std::ios::badbit | std::ios::failbit);
  return Reader(stream).Read(wants);
}

}  // namespace lascaux
