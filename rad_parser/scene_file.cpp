#include "rad_parser/scene_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "rad_parser/binary/octree_file.h"
#include "rad_parser/description_builder.h"
#include "rad_parser/number.h"
#include "rad_parser/open_file.h"
#include "rad_parser/printable.h"
#include "rad_parser/shell_command.h"
#include "rad_parser/text_source.h"
#include "rad_parser/transforms/xform_command.h"

namespace rad {
namespace {

// The circumstances in which a text is read. They also apply to the files and commands in it.
struct Context {
  std::string directory;  // in which commands run; empty: the current one
  const Transform* transform = nullptr;
  int depth = 0;
  int64_t copies = 1;  // number of copies of this file that enclosing commands make
};

// A command as a single line, for messages.
std::string shownCommand(std::string_view command) {
  std::string text = "!";
  for (size_t i = 0; i < command.size(); ++i) {
    const bool continued = command[i] == '\\' && i + 1 < command.size() && command[i + 1] == '\n';
    text += continued ? ' ' : command[i];
    i += continued;
  }
  return text;
}

// Whether the word begins a line of a Wavefront .obj file.
bool isWordOfObj(std::string_view word) {
  constexpr std::array<std::string_view, 9> kWords = {"mtllib", "usemtl", "o",  "g", "v",
                                                      "vn",     "vt",     "vp", "f"};
  return std::ranges::find(kWords, word) != kWords.end();
}

class SceneReader {
 public:
  // alone: whether only one name was given, which may be an octree.
  SceneReader(const ReadOptions& options, bool alone) : options_(options), alone_(alone) {}

  void file(const std::string& name) {
    if (name.starts_with('!')) return command(name.substr(1), {SourceFile::kNoFile, 0}, {});
    const std::optional<std::string> found =
        access(name.c_str(), F_OK) == 0 ? name : findFile(name, libraryPath());
    const uint32_t file = builder_.addFile(found.value_or(name));
    const OpenFile input(found.value_or(name));
    if (input.descriptor() < 0)
      throw systemError(fmt::format("{}: cannot open {} file", name.empty() ? "\"\"" : printableName(name),
                                    name.ends_with(".oct") ? "octree" : "scene"));
    const std::string ahead = readBeginning(input.descriptor());
    const bool mayBeOctree = !ahead.empty() || name.ends_with(".oct");
    if (!mayBeOctree || !octree(input.descriptor(), file, ahead)) {
      TextSource text(input.descriptor(), file, builder_, ahead);
      all(text, {}, file);
    }
    input.requireUnchanged(found.value_or(name));
  }

  void octreeFile(const std::string& name) {
    const std::optional<std::string> found = findFile(name, libraryPath(), {}, options_.files);
    if (!found)
      throw Error(fmt::format("{}: cannot find octree file{}", printableName(name),
                              options_.files.remark(name, true)),
                  Status::system);
    const OpenFile input(*found);
    if (input.descriptor() < 0) throw systemError(printableName(*found) + ": cannot open octree file");
    const uint32_t file = builder_.addFile(*found);
    const std::string ahead = readBeginning(input.descriptor());
    if (!octree(input.descriptor(), file, ahead))
      throw Error(printable(*found, kLongestName) + ": not an octree");
    input.requireUnchanged(*found);
  }

  void memory(std::string_view text, std::string_view name) {
    const uint32_t file = builder_.addFile(name);
    TextSource source(text, file, builder_);
    all(source, {}, file);
  }

  Description take() { return builder_.take(); }

 private:
  // If the data, which begin with `ahead`, are an octree, reads it and returns true. An empty octree is an
  // error. Returns false for other data.
  bool octree(int descriptor, uint32_t file, std::string_view ahead) {
    const std::string name = builder_.description().files[file].name;
    if (!ahead.empty() && !isOctree(ahead, name)) return false;
    if (!alone_)
      throw Error(printable(name, kLongestName) +
                  ": an octree is a whole scene: it cannot be combined with other files");
    ofOctree_ = true;
    BinaryReader input(descriptor, name, "octree", ahead);
    readOctree(input, file, builder_, options_.warn, [&](const std::string& scene) {
      if (scene.starts_with('!')) return command(scene.substr(1), {file, 0}, {});
      const uint32_t sceneFile = builder_.addFile(scene, {file, 0});
      if (!options_.files.allows(scene))
        throw builder_.error({sceneFile, 0}, fmt::format("cannot open scene file{}", options_.files.remark()),
                             Status::system);
      const OpenFile opened(scene);
      if (opened.descriptor() < 0)
        throw builder_.error({sceneFile, 0},
                             fmt::format("cannot open scene file: {} (an octree that is not frozen is used "
                                         "in the folder that it was made in)",
                                         std::strerror(errno)),
                             Status::system);
      TextSource text(opened.descriptor(), sceneFile, builder_);
      all(text, {}, sceneFile);
      opened.requireUnchanged(scene);
    });
    return true;
  }

  // Reads a whole text. quiet: suppresses the warning if it contains no primitive.
  void all(TextSource& text, const Context& context, uint32_t file, bool quiet = false) {
    const size_t before = builder_.description().primitives.size();
    text.skipByteOrderMark();
    for (int c; (c = text.peek()) >= 0;) {
      if (c == '#') {
        text.skipLine();
      } else if (c == '!') {
        const Place place = text.place();
        command(text.line().substr(1), place, context);
      } else {
        primitive(text, context);
      }
    }
    if (!quiet && builder_.description().primitives.size() == before) warn({file, 1}, "empty file");
  }

  // from: the place of the command; from.file is kNoFile if the command was given instead of a file name.
  void command(const std::string& line, Place from, const Context& context) {
    const std::string shown = shownCommand(line);
    const Place place = from.file == SourceFile::kNoFile ? Place{builder_.addFile(shown), 1} : from;
    if (context.depth == kDeepestNesting)
      throw builder_.error(
          place, fmt::format("{} nested files and commands: does one include itself?", kDeepestNesting));
    const auto words = plainWords(line);
    if (words && !words->empty() && words->front() == "xform") return xform(*words, place, context);
    if (!options_.commands)
      throw builder_.error(place, fmt::format("commands are not allowed: \"{}\"", printable(shown)));
    const uint32_t file = from.file == SourceFile::kNoFile ? place.file : builder_.addFile(shown, from);
    shell(line, shown, file, place, from, context);
  }

  void shell(const std::string& line, const std::string& shown, uint32_t file, Place place, Place from,
             const Context& context) {
    Context inner = context;
    ++inner.depth;
    std::optional<ShellCommand> running;
    try {
      running.emplace(line, context.directory);
    } catch (const std::system_error& fault) {
      throw builder_.error(place,
                           fmt::format("cannot execute command: {}", std::strerror(fault.code().value())),
                           Status::system);
    }
    // A command given in place of a file name may output an octree.
    const bool named = from.file == SourceFile::kNoFile;
    const std::string ahead = named ? readBeginning(running->output()) : std::string();
    const size_t before = builder_.description().primitives.size();
    if (ahead.empty() || !octree(running->output(), file, ahead)) {
      TextSource text(running->output(), file, builder_, ahead);
      all(text, inner, file, true);
    }
    const std::string fault = running->finish();
    if (named && alone_ && ahead.empty())
      throw builder_.error({file, 0},
                           fmt::format("not an octree: 0 bytes{}{}; a command that is given as the "
                                       "scene must write an octree or scene text to standard output",
                                       fault.empty() ? "" : ", ", fault));
    if (builder_.description().files[file].numbered) place.line = 0;
    if (!fault.empty()) badStatus(place, shown, fault, ofOctree_ && !named);
    if (builder_.description().primitives.size() == before)
      warn(place, fmt::format("\"{}\" writes nothing", printable(shown)));
  }

  // After the failure of a command, surfaces may be missing without any sign in the results. The failure is
  // therefore an error, except in the scene files of an octree (goesOn), which was made without these
  // surfaces. The same holds for xform().
  void badStatus(Place place, const std::string& shown, const std::string& fault, bool goesOn) const {
    const std::string text = fmt::format("bad status from \"{}\": {}", printable(shown), fault);
    if (!goesOn) throw builder_.error(place, text + "; surfaces that it makes may be missing from the scene");
    warn(place, text);
  }

  void xform(const std::vector<std::string>& words, Place place, const Context& context) {
    // The indices of files by path, because each element of an array reads all of its files again.
    std::vector<std::pair<std::string, uint32_t>> seen;
    try {
      const int64_t copies = context.copies * copiesOfArrays(words, context.copies);
      forEachPass(words, context.directory, options_.files, [&](const XformPass& pass) {
        if (++passes_ > kMostPasses) throw tooMany();
        const Transform nested =
            context.transform ? within(*context.transform, pass.transform) : pass.transform;
        for (const std::string& name : pass.files) {
          auto path = findFile(name, libraryPath(), context.directory, options_.files);
          if (!path) path = fileBeside(builder_.description(), place, name, options_.files);
          if (!path)
            throw XformFault(fmt::format("xform: cannot find file \"{}\"{}", printableName(name),
                                         options_.files.remark(name, true)),
                             Status::system);
          auto known = std::ranges::find_if(seen, [&](const auto& s) { return s.first == *path; });
          const bool again = known != seen.end();
          if (!again) known = seen.insert(known, {*path, builder_.addFile(*path, place)});
          const OpenFile input(*path);
          if (input.descriptor() < 0)
            throw XformFault(
                fmt::format("xform: cannot open file \"{}\": {}", printableName(name), std::strerror(errno)),
                Status::system);
          TextSource text(input.descriptor(), known->second, builder_);
          const Context inner{pass.changesDirectory ? directoryOf(*path) : context.directory, &nested,
                              context.depth + 1, copies};
          all(text, inner, known->second, again);
          input.requireUnchanged(*path);
        }
      });
    } catch (const XformFault& fault) {
      if (!ofOctree_) throw builder_.error(place, fault.what(), fault.status());
      warn(place, fault.what());
    }
  }

  void primitive(TextSource& text, const Context& context) {
    const Transform* transform = context.transform;
    std::string_view word;
    text.word(word);
    const Place place = text.place();
    modifier_ = word;
    PrimitiveId modifier = builder_.modifier(modifier_);
    const bool isVoid = modifier_ == "void", inherits = modifier_ == "inherit";
    const auto undefined = [&](std::string_view why) {
      return builder_.error(place, fmt::format("undefined modifier \"{}\"{}", printable(modifier_), why));
    };

    Type type;
    const bool hasType = text.word(word);
    if (!hasType || !findType(word, type)) {
      if (modifier == kVoid && !isVoid && !inherits) throw undefined(whyNoPrimitive(place));
      if (!hasType) throw builder_.error(place, fmt::format("text ends after \"{}\"", printable(modifier_)));
      throw builder_.error(text.place(),
                           fmt::format("unknown type \"{}\"{}", printable(word), nearestType(word)));
    }
    if (transform && transform->modifier && isSurface(type)) {
      modifier_ = *transform->modifier;
      modifier = builder_.modifier(modifier_);
    }
    if (modifier_ == "void") {
      modifier = kVoid;
    } else if (modifier_ == "inherit") {
      if (type != Type::alias) throw builder_.error(place, "\"inherit\" is for aliases only");
    } else if (modifier == kVoid) {
      throw undefined(builder_.nearestModifier(modifier_));
    }

    if (!text.word(word)) throw ends(place, type, "");
    if (word.find('\t') != word.npos)
      throw builder_.error(text.place(), fmt::format("tab in name \"{}\"", printable(word)));
    if (!isSurface(type) && (word == "void" || word == "inherit"))
      throw builder_.error(text.place(), fmt::format("no modifier can be named \"{}\"", word));
    if (transform) {
      word = transform->nameOf(type, word, name_);
      type = transform->typeOf(type);
    }
    Primitive p = builder_.begin(type, place, word, modifier);
    if (type == Type::alias)
      alias(text, p, inherits);
    else
      arguments(text, p);
    if (transform) transform->apply(p, builder_);
    builder_.add(p);
  }

  // The end of the error message for an undefined modifier_ that is not followed by a type: the probable
  // mistake of the user.
  std::string whyNoPrimitive(Place place) const {
    const Description& description = builder_.description();
    const bool first =
        description.primitives.empty() || description.primitives.back().place.file != place.file;
    if (first && isWordOfObj(modifier_))
      return "; this seems to be a Wavefront .obj file, which obj2rad converts to a scene file";
    if (!first && parseReal(modifier_)) {
      const Primitive before = description.primitives.back();
      return fmt::format("; a number follows the {} numbers of {} \"{}\" (line {}): is that count too small?",
                         before.reals, typeName(before.type), printable(before.name), before.place.line);
    }
    return builder_.nearestModifier(modifier_);
  }

  void alias(TextSource& text, Primitive& p, bool inherits) {
    std::string_view word;
    if (!text.word(word)) throw ends(p);
    const PrimitiveId reference = builder_.modifier(word);
    if (reference == kVoid)
      throw builder_.error(text.place(),
                           fmt::format("alias \"{}\": undefined modifier \"{}\"{}", printable(p.name),
                                       printable(word), builder_.nearestModifier(word)));
    builder_.addString(p, word);
    builder_.resolveAlias(p, reference, inherits);
  }

  void arguments(TextSource& text, Primitive& p) {
    const int64_t strings = count(text, p, "string");
    std::string_view word;
    for (int64_t i = 0; i < strings; ++i) {
      if (!text.word(word)) throw ends(p);
      builder_.addString(p, word);
    }
    if (const int64_t integers = count(text, p, "integer"); integers != 0)
      throw fault(text, p, fmt::format("{} integer arguments, but no type has any", integers));
    const int64_t reals = count(text, p, "real");
    double value = 0;
    for (int64_t i = 0; i < reals; ++i) {
      if (!text.real(value)) {
        if (text.lastWord().empty() && text.peek() < 0) throw ends(p);
        throw fault(text, p,
                    fmt::format("expected {} numbers, but number {} is \"{}\"", reals, i + 1,
                                printable(text.lastWord())));
      }
      builder_.addReal(p, value);
    }
  }

  int64_t count(TextSource& text, const Primitive& p, const char* what) {
    int64_t n = 0;
    if (!text.integer(n)) {
      if (text.lastWord().empty() && text.peek() < 0) throw ends(p);
      throw fault(
          text, p,
          fmt::format("expected the number of {} arguments, got \"{}\"", what, printable(text.lastWord())));
    }
    if (n < 0 || n > kMostArguments) throw fault(text, p, fmt::format("{} {} arguments", n, what));
    return n;
  }

  Error fault(const TextSource& text, const Primitive& p, std::string_view why) const {
    return builder_.error(text.place(),
                          fmt::format("{} \"{}\": {}", typeName(p.type), printable(p.name), why));
  }

  Error ends(const Primitive& p) const { return ends(p.place, p.type, p.name); }

  Error ends(Place place, Type type, std::string_view name) const {
    return builder_.error(place, fmt::format("text ends within {} \"{}\"", typeName(type), printable(name)));
  }

  void warn(Place place, std::string_view text) const {
    if (options_.warn) options_.warn(fmt::format("{}: {}", builder_.description().at(place), text));
  }

  static constexpr int64_t kMostArguments = 0x7fffffff;  // for each kind of argument in one primitive

  const ReadOptions& options_;
  const bool alone_;
  bool ofOctree_ = false;  // whether the scene files of an octree are being read
  DescriptionBuilder builder_;
  int64_t passes_ = 0;           // in all xform commands together
  std::string modifier_, name_;  // of the current primitive; members, so that their memory is reused
};

}  // namespace

Description readScene(std::span<const std::string> names, const ReadOptions& options) {
  SceneReader reader(options, names.size() == 1);
  for (const std::string& name : names) reader.file(name);
  return reader.take();
}

Description readSceneText(std::string_view text, std::string_view name, const ReadOptions& options) {
  SceneReader reader(options, false);
  reader.memory(text, name);
  return reader.take();
}

Description readOctree(const std::string& name, const ReadOptions& options) {
  SceneReader reader(options, true);
  reader.octreeFile(name);
  return reader.take();
}

std::optional<std::string> fileBeside(const Description& description, Place place, std::string_view name,
                                      const FileAccess& access) {
  if (name.empty() || name[0] == '/' || name[0] == '~') return {};
  const SourceFile* file = &description.files[place.file];
  while (file->name.starts_with('!')) {
    if (file->from.file == SourceFile::kNoFile) return {};
    file = &description.files[file->from.file];
  }
  const std::string folder = directoryOf(file->name);
  const bool standsAlone = folder.starts_with('/') || folder.starts_with('.');
  auto path = findFile(joinPath(standsAlone ? folder : "./" + folder, name), {}, {}, access);
  std::error_code none;
  if (path && std::filesystem::is_directory(*path, none)) path.reset();
  return path;
}

std::optional<std::string> findNamedFile(const Description& description, Place place, std::string_view name,
                                         const FileAccess& access) {
  auto path = findFile(name, libraryPath(), {}, access);
  return path ? path : fileBeside(description, place, name, access);
}

std::string nameOfFile(const Description& description, Place place, std::string_view name,
                       const FileAccess& access) {
  if (findFile(name, libraryPath(), {}, access)) return std::string(name);
  return fileBeside(description, place, name, access).value_or(std::string(name));
}

}  // namespace rad
