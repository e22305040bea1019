#pragma once
// The arguments of patterns, textures, mixtures and materials. Each kind of primitive has a struct, and a
// reader that checks the number and range of its arguments. Materials without functions and without names of
// other modifiers are read directly into their structs.
//
// Each reader throws rad::Error with the file and line of the primitive if an argument is missing or out of
// range. Files and modifiers that arguments name are not looked up. Words refer to the description, which may
// grow but must outlive them. REQUIRES that the primitive has one of the types listed above the struct.
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "scene/arguments.h"
#include "scene/material.h"

namespace rsphere {

// A function file, and a transform of its coordinates; empty if there is none.
struct FunctionFile {
  std::string_view name;  // "." if no function file is needed
  Words transform;
};

// ---- patterns, textures and mixtures

// The modifiers that a mixture blends; both empty for patterns and textures.
struct Mixed {
  std::string_view foreground, background;
};

// brightfunc, mixfunc: one expression. colorfunc, texfunc: three.
struct FunctionArguments {
  Mixed mixed;
  Words expressions;
  FunctionFile file;
};
FunctionArguments readFunction(const PrimitiveArguments& arguments);

// brightdata, mixdata, specdata: one table and one correction. colordata, texdata: three of each.
struct DataArguments {
  Mixed mixed;
  Words corrections;      // functions of the values of the tables
  Words tables;           // data files
  std::string_view file;  // the function file for corrections and coordinates
  // The coordinates, as many as the tables have dimensions, then the transform. specdata has one coordinate
  // less, because the last dimension is the wavelength.
  Words rest;
};
DataArguments readData(const PrimitiveArguments& arguments);

// colorpict: three corrections. mixpict, specpict: one.
struct PictureArguments {
  Mixed mixed;
  Words corrections;  // functions of the color of the picture
  std::string_view picture;
  Words coordinates;  // two
  FunctionFile file;
};
PictureArguments readPicture(const PrimitiveArguments& arguments);

// brighttext, colortext, mixtext. The text is either in a file or in the arguments.
struct TextArguments {
  Mixed mixed;
  std::string_view font, file;
  Words words;                                     // the text; empty if it is in the file
  V3d anchor, right, down;                         // world units
  std::vector<double> foreground{}, background{};  // by channel: 1, 3, or none for mixtext
  std::optional<double> spacing{};                 // between characters; empty: that of the font
};
TextArguments readText(const PrimitiveArguments& arguments);

// spectrum. The values are means over bins of equal width, whose middles run from `first` to `last` (nm).
struct SpectrumArguments {
  double first = 0, last = 0;
  std::vector<double> values;  // at least three
};
SpectrumArguments readSpectrum(const PrimitiveArguments& arguments);

// specfile
struct SpectrumFileArguments {
  std::string_view data;  // a data file
};
SpectrumFileArguments readSpectrumFile(const PrimitiveArguments& arguments);

// specfunc
struct SpectralFunctionArguments {
  std::string_view function;  // of the wavelength (nm)
  FunctionFile file;
  double shortest = 0, longest = 0;  // nm
};
SpectralFunctionArguments readSpectralFunction(const PrimitiveArguments& arguments);

// ---- materials without functions

Opaque readOpaque(const PrimitiveArguments& arguments);  // plastic, metal
Trans readTrans(const PrimitiveArguments& arguments);
Dielectric readDielectric(const PrimitiveArguments& arguments);
Interface readInterface(const PrimitiveArguments& arguments);
Glass readGlass(const PrimitiveArguments& arguments);
Mist readMist(const PrimitiveArguments& arguments);  // Mist::number remains 0
Light readLight(const PrimitiveArguments& arguments);
Glow readGlow(const PrimitiveArguments& arguments);
Spotlight readSpotlight(const PrimitiveArguments& arguments);

// mirror, illum: a color, and the name of the alternate material (may be "void"); empty if it is not given.
struct AlternatingArguments {
  Color color;  // reflectance of mirror, radiance of illum
  std::optional<std::string_view> alternate;
};
AlternatingArguments readAlternating(const PrimitiveArguments& arguments);

// The names of the modifiers that are clipped; the first one also shades the cut.
Words readAntimatter(const PrimitiveArguments& arguments);

// ---- materials with functions. The readers leave `functions` and indices of modifiers in `values` unset.

// Expressions for the direction that orients elliptical highlights.
struct OrientationArguments {
  Words direction;  // ux uy uz
  FunctionFile file;
};

// plastic2, metal2, trans2
struct AnisotropicArguments {
  Anisotropic values;
  OrientationArguments orientation;
};
AnisotropicArguments readAnisotropic(const PrimitiveArguments& arguments);

struct AshikhminArguments {
  Ashikhmin values;
  OrientationArguments orientation;
};
AshikhminArguments readAshikhmin(const PrimitiveArguments& arguments);

// plasfunc, metfunc, transfunc
struct FunctionScattererArguments {
  FunctionScatterer values;
  std::string_view distribution;  // a function
  FunctionFile file;
};
FunctionScattererArguments readFunctionScatterer(const PrimitiveArguments& arguments);

// plasdata, metdata, transdata
struct DataScattererArguments {
  FunctionScatterer values;
  std::string_view correction;  // a function of the table's value
  std::string_view table;       // a data file
  FunctionFile file;
  Words rest;  // the coordinates, as many as the table has dimensions, then the transform
};
DataScattererArguments readDataScatterer(const PrimitiveArguments& arguments);

struct BrtdArguments {
  BrtdFunction values;
  Words reflection, transmission;  // expressions, three each
  Words distribution;              // functions, three; "0": none
  FunctionFile file;
};
BrtdArguments readBrtd(const PrimitiveArguments& arguments);

struct WgmdArguments {
  struct Lobe {
    std::string_view modifier;  // "inherit": the material's
    Words shape;                // expressions: share, roughness along and across
  };
  WgmdFunction values;
  Lobe reflected, transmitted;
  std::string_view diffuseTransmittedModifier;
  OrientationArguments orientation;
};
WgmdArguments readWgmd(const PrimitiveArguments& arguments);

// BSDF, aBSDF
struct BsdfArguments {
  BsdfMaterial values;
  std::optional<std::string_view> thickness;  // an expression; empty for aBSDF
  std::string_view data;                      // the XML file
  OrientationArguments up;
};
BsdfArguments readBsdf(const PrimitiveArguments& arguments);

// prism1, prism2
struct PrismArguments {
  std::vector<Words> images;  // for each, four expressions: a coefficient and a direction
  FunctionFile file;
};
PrismArguments readPrism(const PrimitiveArguments& arguments);

// The arguments of modifiers that are evaluated at each hit, by functions, data, a picture or text.
using EvaluatedArguments =
    std::variant<FunctionArguments, DataArguments, PictureArguments, TextArguments, SpectrumArguments,
                 SpectrumFileArguments, SpectralFunctionArguments, AnisotropicArguments, AshikhminArguments,
                 FunctionScattererArguments, DataScattererArguments, BrtdArguments, WgmdArguments,
                 BsdfArguments, PrismArguments>;

}  // namespace rsphere
