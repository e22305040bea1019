#include "rad_parser/rayinit/interface.h"

#include "rad_parser/rayinit/host_functions.h"

namespace rad::calc {

Interface sceneInterface(const FileAccess& access) {
  Interface i;
  i.inputs = {"Dx", "Dy",  "Dz",  "Nx",  "Ny",    "Nz",  "Px",  "Py",  "Pz",  "T",   "Rdot", "S",  "Tx",
              "Ty", "Tz",  "Ix",  "Iy",  "Iz",    "Jx",  "Jy",  "Jz",  "Kx",  "Ky",  "Kz",   "Ts", "Lu",
              "Lv", "NxP", "NyP", "NzP", "RdotP", "CrP", "CgP", "CbP", "DxA", "DyA", "DzA"};
  i.hosts = sceneHostFunctions();
  i.preludeName = "rayinit.cal";
  i.preludeText = kRayinit;
  i.searched = [access](std::string_view file) { return access.remark(file); };
  return i;
}

}  // namespace rad::calc
