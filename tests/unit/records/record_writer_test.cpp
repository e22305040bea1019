#include "records/record_writer.h"

#include <csignal>

#include "tests/unit/support/command_line.h"

namespace rsphere {
namespace {

TEST(RecordWriter, WritesInBlocksAndOnFlush) {
  const TemporaryFile file;
  RecordWriter writer(file.descriptor);
  writer.write("abc");
  EXPECT_EQ(contents(file.path), "");
  EXPECT_EQ(writer.position(), 3);
  writer.flush();
  EXPECT_EQ(contents(file.path), "abc");
  const std::string block(70000, 'x');
  writer.write(block);
  EXPECT_EQ(contents(file.path), "abc" + block);
  writer.holdUntilFlush(true);
  writer.write(block);
  EXPECT_EQ(contents(file.path), "abc" + block);
  writer.flush();
  EXPECT_EQ(contents(file.path), "abc" + block + block);
}

TEST(RecordWriter, PipesCannotSeek) {
  Pipe pipe;
  EXPECT_EQ(RecordWriter(pipe.in).position(), std::nullopt);
}

TEST(RecordWriter, ClosedPipeAndFullDisk) {
  std::signal(SIGPIPE, SIG_IGN);
  Pipe pipe;
  pipe.closeOut();
  RecordWriter writer(pipe.in);
  writer.write("x");
  EXPECT_THROW(writer.flush(), ClosedPipe);
  EXPECT_NO_THROW(writer.flush()) << "the bytes are gone";
  const int full = open("/dev/full", O_WRONLY);
  RecordWriter onFull(full);
  onFull.write("x");
  EXPECT_EQ(faultOf([&] { onFull.flush(); }, rad::Status::system), "write error: No space left on device");
  close(full);
}

}  // namespace
}  // namespace rsphere
