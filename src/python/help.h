#pragma once
// The texts of help(rsphere) in Python.

namespace rsphere::python {

constexpr const char* kScene = R"(A scene, read from files.

files: one octree, or scene files in their order, or '!command'; one path or a list.
commands: False if the scene is untrusted: its !commands are refused, and so are files outside its folders and
RAYPATH.
goals: modifiers of goals; their surfaces emit importance 1, all others nothing.
Raises rsphere.Error.)";

constexpr const char* kInit = "Scene(files: str | list[str], commands: bool = True, goals: list[str] = [])";

constexpr const char* kOptions = R"(
Options by name: ambient_bounces, ambient_accuracy, ambient_divisions, ambient_super_samples,
ambient_resolution, ambient_value, limit_reflections, limit_weight, rotation, irradiance_at_origin,
irradiance_at_surface (both of rays), accuracy (relative standard error of rays and points), directions,
most_directions, bins (zones of directions; all of points), outputs (letters of -o), threads (0: one for each
core), arguments (a list of words as on the command line). Any other option of the command is a keyword
without its hyphen: ab=5, av=(.1, .1, .1), dv=False; as_=512 is -as 512. Options that are neither switches nor
have values, such as -pY, go into arguments=["-pY"].

Calls that repeat the same options are fast; only threads, outputs and colors may differ.
Raises rsphere.Error.)";

constexpr const char* kTrace = R"(trace(rays: array (n, 6), **options) -> rsphere.Answers

Traces rays: origins and directions.

Returns an object with an array for each letter of outputs ("v" if not given), and None for others:
v value (n, 3): radiance (W/sr/m2), or irradiance (W/m2) with irradiance_at_origin (-I) or
irradiance_at_surface (-i); e standard_error: that of value, estimated;
o origin, d direction, p point, n normal, N unperturbed_normal, L first_length, l effective_length,
c local_coordinates, w weight, W coefficient, V contribution,
r mirrored_value, R mirrored_length, x unmirrored_value, X unmirrored_length, s surface, m modifier,
M material.
)";

constexpr const char* kSphere = R"(sphere(points: array (n, 3), **options) -> rsphere.Answers

Computes what passes through points from all directions: an array (n, 3).

Returns an object with an array for each letter of outputs ("veECHuk" if not given), and None for others. F is
the integral of radiance over 4 pi sr.
v mean (n, 3): F/(4 pi) (W/sr/m2), e mean_standard_error: that of mean, estimated,
E scalar_irradiance: F/4 (W/m2), C cylindrical_irradiance, S semicylindrical_irradiance (towards So degrees),
h hemispherical_irradiance, H face_irradiance (n, 6, 3): +x -x +y -y +z -z, u light_vector, k directions,
o point. An e after one of the letters E C S h H u is the standard error of that quantity: with outputs
"CeHe", cylindrical_irradiance_standard_error and face_irradiance_standard_error.
With Sp=True, what each modifier of a light source gives: contributors are their names, and arrays but
directions and point have a second axis for them. With bins=N: bins (n, N, 3), mean radiances of zones of
equal solid angle, bins_standard_error, and bins_solid_angle (N); zone_middles(N) has the directions of the
zones. bins may also be a dict that numbers directions Dx, Dy, Dz as rcontrib does, with the keys expression,
count, parameters and files: {"files": "reinhart.cal", "parameters": "MF=1", "expression": "rbin", "count":
"Nrbins"}. Directions of other numbers are in no bin. Borders are followed to .1 degrees.
)";

constexpr const char* kImportance =
    R"(importance(points: array (n, 3), goals: list[str] | array (goals, 6), **options) -> rsphere.Answers

Computes the importance of each goal at points, of all in one pass.

points: an array (n, 3). goals: modifiers whose surfaces emit importance 1 W/sr/m2 from their front; all
other sources are dark. Returns the object of sphere() whose contributors are the goals, and whose arrays have
a second axis for them: mean (n, goals, 3), mean_standard_error, face_irradiance (n, goals, 6, 3).

With bins=N: bins (n, goals, N, 3), the mean importance in each of N zones of equal solid angle, and
bins_standard_error; or with bins of your own, as for sphere().

Goals may also be sensors or eyes, an array (goals, 6) of places and the directions in which they face:
places without a surface, which block and reflect nothing, receive light by the cosine, and count as goals of
area 1.

By reciprocity, a lamp at the point of 1 cd in all directions gives a goal of area A (m2) the mean illuminance
4 pi mean / A (lx), and a small downlight of cos(angle to -z) cd gives it face_irradiance[:, :, 5] / A.
)";

constexpr const char* kGlare =
    R"(glare(eyes: array (n, 3), gazes: array (n, 3) or (3,), **options) -> rsphere.Answers

Computes glare at eyes.

eyes: an array (n, 3). gazes: the directions in which they look, (n, 3), or one (3,) for all; not vertical, z
is up. Returns an object with an array (n,) for each letter of outputs (all if not given), None for others:
u ugr: unified glare rating (CIE 117), v illuminance at the eye (lx), b background luminance (cd/m2),
g dgp: daylight glare probability (Wienold and Christoffersen 2006), U V B G their standard errors:
ugr_standard_error, ...; t threshold of glare sources (cd/m2).
sources: for each eye an object with an array (k,) of each figure of its k glare sources, the worst first:
direction (k, 3), luminance (cd/m2), luminance_standard_error, solid_angle (sr), solid_angle_standard_error,
position_index, surface (a list of names). Sub=..., Sut=(below, opening): threshold and task.
)";

constexpr const char* kContributions =
    R"(contributions(rays: array (n, 6), of: list[str], *, bins: None | int | dict = None, samples: int = 8,
              coefficients: bool = False, **options) -> rsphere.Answers

Computes what modifiers contribute to rays: an array of shape (n, 6), origins and directions.

of: modifiers: light sources, the sky, goals or any other surfaces.
bins: None, or a number of zones of equal solid angle in which the directions lie of rays that meet a modifier
(zone_middles()), or a dict: {"expression": "rbin", "count": "Nrbins", "parameters": "MF=4", "files":
["reinhartb.cal"]}, as -b, -bn, -p and -f of rcontrib.
samples: times that each ray is traced. accuracy: instead, as many as the relative standard error of the sum
over all modifiers and bins takes, with all bounces. coefficients: factors on the radiance of the modifiers
instead of values. Returns an object: value (n, of, bins, 3): radiance (W/sr/m2), or irradiance (W/m2) with
irradiance_at_origin (-I); standard_error of the same shape, from the spread of the samples; modifiers.
Defaults are those of rcontrib, without interpolation.
)";

}  // namespace rsphere::python
