#include "field/ambient_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "field/fingerprint.h"

namespace rsphere {
namespace {

constexpr size_t kHeader = 69, kSceneEnd = 42;  // bytes; kSceneEnd: end of the line that identifies the scene
constexpr size_t kRecord = sizeof(AmbientFile::Record) + sizeof(uint64_t);
constexpr std::string_view kSuffix = ".rsphere";
constexpr std::string_view kMagic = "#?RSPHERE ambient 1\n";

std::string header(uint64_t scene, uint64_t options) {
  return fmt::format("{}SCENE={:016x}\nOPTIONS={:016x}", kMagic, scene, options) + "\n\n";
}

uint64_t checksum(const AmbientFile::Record& record) {
  Fingerprint print;
  print.add(std::string_view(reinterpret_cast<const char*>(record.data()), record.size()));
  return print.value();
}

// Repeats pread() or pwrite() until all bytes are transferred. False on an error or if the file ends too
// early.
bool transferAll(const auto& transfer, int descriptor, auto* bytes, size_t size, off_t offset) {
  for (size_t done = 0; done < size;) {
    const ssize_t n = transfer(descriptor, bytes + done, size - done, offset + static_cast<off_t>(done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += static_cast<size_t>(n);
  }
  return true;
}

bool readAll(int descriptor, void* to, size_t size, off_t offset) {
  return transferAll(pread, descriptor, static_cast<char*>(to), size, offset);
}

bool writeAll(int descriptor, std::string_view bytes, off_t offset) {
  return transferAll(pwrite, descriptor, bytes.data(), bytes.size(), offset);
}

off_t sizeOf(int descriptor) {
  struct stat status {};
  return fstat(descriptor, &status) == 0 ? status.st_size : -1;
}

bool lock(int descriptor, int how) {
  int result = 0;
  do result = flock(descriptor, how);
  while (result != 0 && errno == EINTR);
  return result == 0;
}

}  // namespace

AmbientFile::AmbientFile(std::string name, int descriptor, bool writable, rad::Warn warn)
    : name_(std::move(name)), descriptor_(descriptor), writable_(writable), warn_(std::move(warn)) {}

AmbientFile::~AmbientFile() { close(descriptor_); }

std::unique_ptr<AmbientFile> AmbientFile::open(const std::string& name, uint64_t scene, uint64_t options,
                                               const rad::Warn& warn) {
  bool writable = true;
  int descriptor = ::open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0 && (errno == EACCES || errno == EROFS)) {
    const int refused = errno;
    writable = false;
    descriptor = ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) errno = refused;
  }
  struct stat status {};
  if (descriptor < 0) throw rad::systemError(fmt::format("cannot open ambient file \"{}\"", name));
  std::unique_ptr<AmbientFile> file(new AmbientFile(name, descriptor, writable, warn));
  // The user gives /dev/null to keep nothing.
  if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return nullptr;
  if (!file->begin(scene, options)) return nullptr;
  file->read();
  return file;
}

std::unique_ptr<AmbientFile> AmbientFile::openBeside(const std::string& given, uint64_t scene,
                                                     uint64_t options, const rad::Warn& warn) {
  struct stat status {};
  const bool there = stat(given.c_str(), &status) == 0;
  if (there && S_ISDIR(status.st_mode))
    throw rad::Error(fmt::format("cannot open ambient file \"{}\": {}", given, std::strerror(EISDIR)),
                     rad::Status::system);
  if (there && !S_ISREG(status.st_mode)) return nullptr;
  try {
    return open(fmt::format("{}{}", given, kSuffix), scene, options, warn);
  } catch (const rad::Error& error) {
    if (!there) throw;
    if (warn) warn(fmt::format("{}: indirect light is not kept", error.what()));
    return nullptr;
  }
}

// Writes or checks the header.
bool AmbientFile::begin(uint64_t scene, uint64_t options) {
  const std::string ours = header(scene, options);
  std::string found;
  if (writable_ && !lock(descriptor_, LOCK_EX))
    throw rad::systemError(fmt::format("cannot lock ambient file \"{}\"", name_));
  const off_t size = sizeOf(descriptor_);
  found.resize(std::min<size_t>(kHeader, static_cast<size_t>(std::max<off_t>(size, 0))));
  const bool readable = readAll(descriptor_, found.data(), found.size(), 0);
  // An incomplete header is left by a process that was killed while it wrote the header.
  const bool begun = found.size() < kHeader && header(0, 0).starts_with(found.substr(0, kMagic.size()));
  bool written = true;
  if (readable && begun && writable_)
    written = ftruncate(descriptor_, 0) == 0 && writeAll(descriptor_, ours, 0);
  if (writable_) lock(descriptor_, LOCK_UN);
  if (!readable || !written)
    throw rad::systemError(fmt::format("cannot {} ambient file \"{}\"", readable ? "write" : "read", name_));
  if (begun || found == ours) return true;
  std::string why = "is not an ambient file";
  if (found.starts_with(kMagic))
    why = found.substr(0, kSceneEnd) == ours.substr(0, kSceneEnd)
              ? "was made with other options or by another version"
              : "was made for another scene";
  else if (found.starts_with("#?RADIANCE"))
    why = "is one of RADIANCE's own";
  if (warn_) warn_(fmt::format("ambient file \"{}\" {}: not used, and left as it is", name_, why));
  return false;
}

void AmbientFile::read() {
  const off_t size = sizeOf(descriptor_);
  if (size < static_cast<off_t>(kHeader)) return;
  const size_t count = (static_cast<size_t>(size) - kHeader) / kRecord;
  std::string bytes(count * kRecord, '\0');
  if (!readAll(descriptor_, bytes.data(), bytes.size(), kHeader)) return;
  records_.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    Record record;
    uint64_t sum = 0;
    std::memcpy(record.data(), bytes.data() + i * kRecord, record.size());
    std::memcpy(&sum, bytes.data() + i * kRecord + record.size(), sizeof sum);
    if (sum == checksum(record)) records_.push_back(record);
  }
}

bool AmbientFile::add(std::span<const Record> records, bool wait) {
  if (!writable_ || records.empty()) return true;
  if (!lock(descriptor_, wait ? LOCK_EX : LOCK_EX | LOCK_NB)) return false;
  std::string bytes;
  bytes.reserve(records.size() * kRecord);
  for (const Record& record : records) {
    const uint64_t sum = checksum(record);
    bytes.append(reinterpret_cast<const char*>(record.data()), record.size());
    bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  }
  // If the last record is incomplete because its writer was killed, it is overwritten.
  const off_t size = sizeOf(descriptor_);
  const off_t end = size - (size - static_cast<off_t>(kHeader)) % static_cast<off_t>(kRecord);
  const bool written = size >= static_cast<off_t>(kHeader) && writeAll(descriptor_, bytes, end);
  const int why = errno;
  lock(descriptor_, LOCK_UN);
  if (!written) {
    writable_ = false;
    if (warn_) warn_(fmt::format("cannot write ambient file \"{}\": {}", name_, std::strerror(why)));
  }
  return true;
}

}  // namespace rsphere
