// The values are from the material database physicallybased.info (Palmqvist, CC0, April 2026), which
// derives them from the spectra of refractiveindex.info (Polyanskiy 2024). Each entry names the source that
// the database states.
#include "study/materials.hpp"

#include <array>

namespace remapc {
namespace {

constexpr std::array kDielectrics = {
    Dielectric{"Ketchup", 1.3, "Jensen et al. 2001, A Practical Model for Subsurface Light Transport"},
    Dielectric{"Ice", 1.3098, "main/H2O/Warren-2008"},
    Dielectric{"Water", 1.3325, "main/H2O/Daimon-21.5C"},
    Dielectric{"Coffee", 1.34,
               "Narasimhan et al. 2006, Acquiring Scattering Properties of Participating Media by Dilution"},
    Dielectric{"Milk", 1.348, "Jensen et al. 2001, A Practical Model for Subsurface Light Transport"},
    Dielectric{"Blood (Oxygenated)", 1.35, "other/blood/Liu"},
    Dielectric{"Skin I", 1.4, "Jensen et al. 2001, A Practical Model for Subsurface Light Transport"},
    Dielectric{"Plastic (Acrylic)", 1.4905, "3d/plastics/pmma"},
    Dielectric{"Glass (Borosilicate)", 1.52, "3d/glass/BK7"},
    Dielectric{"Glass (Soda-lime)", 1.52, "3d/glass/soda-lime-clear"},
    Dielectric{"Quartz", 1.54, "3d/crystals/quartz"},
    Dielectric{"Plastic (PVC)", 1.542, "organic/polyvinil_chloride/Zhang"},
    Dielectric{"Salt", 1.5441, "3d/crystals/salt"},
    Dielectric{"Plastic (PET)", 1.575, "organic/polyethylene_terephthalate/Zhang"},
    Dielectric{"Plastic (PC)", 1.5848, "3d/plastics/pc"},
    Dielectric{"Polystyrene (Foam)", 1.6, "organic/polystyrene/Zhang"},
    Dielectric{"Sapphire", 1.7682, "3d/crystals/sapphire"},
    Dielectric{"Diamond", 2.4168, "3d/crystals/diamond"},
};

}  // namespace

std::span<const Dielectric> measured_dielectrics() { return kDielectrics; }

}  // namespace remapc
