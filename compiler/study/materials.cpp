// The values are from the material database physicallybased.info (Palmqvist, CC0, April 2026) for linear
// sRGB, which derives them from the spectra of refractiveindex.info (Polyanskiy 2024). Each entry names the
// source that the database states. Some parts of an index are 0 in the database.
#include "study/materials.hpp"

namespace remapc {
namespace {

constexpr std::array kConductors = {
    Conductor{"Aluminum", {0.728978, 0.588215, 0.78354}, {6.45971, 5.19646, 4.37746}, "main/Al/Cheng"},
    Conductor{"Beryllium", {3.21038, 3.32907, 3.77105}, {3.29815, 3.11669, 2.66995}, "main/Be/Rakic-BB"},
    Conductor{"Brass", {0.341048, 0.53349, 1.42749}, {4.14088, 2.67993, 1.87543}, "3d/metals/brass"},
    Conductor{"Cesium", {0.204334, 0.272018, 0.449252}, {1.19256, 0.906033, 0.517209}, "main/Cs/Monin"},
    Conductor{"Chromium", {4.19382, 3.53806, 2.91521}, {4.85545, 4.89986, 4.25568}, "main/Cr/Sytchkova"},
    Conductor{"Cobalt", {3.33754, 2.6841, 2.57555}, {5.27723, 4.73548, 3.81892}, "main/Co/Werner-DFT"},
    Conductor{"Copper", {0.133762, 1.05661, 1.68637}, {3.10615, 2.63095, 2.42655}, "main/Cu/Johnson"},
    Conductor{"Germanium", {5.63391, 5.06611, 4.81402}, {1.44383, 2.25088, 0.279501}, "main/Ge/Aspnes"},
    Conductor{"Gold", {0.0, 0.351563, 1.85894}, {6.59401, 2.08143, 1.49631}, "main/Au/Babar"},
    Conductor{"Iridium", {2.79209, 2.56343, 2.7216}, {5.68877, 5.0549, 4.20215}, "main/Ir/Schmitt-ALD"},
    Conductor{"Iron", {2.73466, 2.94186, 3.15654}, {3.14869, 2.92718, 2.46012}, "3d/metals/iron"},
    Conductor{"Lead", {2.71051, 2.68791, 2.9091}, {4.04246, 4.01366, 4.17426}, "main/Pb/Werner-DFT"},
    Conductor{"Lithium", {0.141612, 0.215656, 0.481854}, {2.7434, 2.48258, 2.35726}, "main/Li/Rasigni"},
    Conductor{"Magnesium", {0.286425, 0.322265, 0.594764}, {6.75553, 4.94909, 4.25174}, "main/Mg/Hagemann"},
    Conductor{"Manganese", {2.22147, 2.02055, 2.03472}, {3.60175, 3.25337, 2.862}, "main/Mn/Querry"},
    Conductor{"Mercury", {1.86932, 1.53811, 1.4963}, {5.36989, 4.60484, 3.92685}, "3d/metals/mercury"},
    Conductor{"Molybdenum", {4.13827, 4.14866, 4.27845}, {3.90428, 4.00545, 3.21018}, "main/Mo/Werner-DFT"},
    Conductor{"Nickel", {1.8644, 1.92207, 2.22915}, {4.21007, 3.57008, 2.87501}, "main/Ni/Johnson"},
    Conductor{"Palladium", {1.88141, 1.79976, 2.00737}, {4.66959, 4.03631, 3.43839}, "main/Pd/Palm"},
    Conductor{"Platinum", {2.17679, 2.02616, 2.34437}, {5.44798, 4.54881, 3.74446}, "main/Pt/Werner-DFT"},
    Conductor{"Potassium", {0.0, 0.041228, 0.220328}, {3.37295, 1.56367, 2.05971}, "main/K/Monin"},
    Conductor{"Rubidium", {0.0391755, 0.101768, 0.205178}, {1.22619, 1.27629, 1.13104}, "main/Rb/Monin"},
    Conductor{"Silicon", {3.65156, 4.08561, 4.36337}, {0.972551, 0.0, 0.0}, "main/Si/Aspnes"},
    Conductor{"Silver", {0.0, 0.0626977, 0.382178}, {8.06675, 3.62828, 3.80086}, "main/Ag/Babar"},
    Conductor{"Sodium", {0.0, 0.0669661, 0.325253}, {4.94428, 2.3243, 2.89317}, "main/Na/Smith"},
    Conductor{"Stainless Steel",
              {2.22981, 2.04109, 2.15682},
              {4.21948, 3.64081, 3.07445},
              "3d/metals/stainless_steel"},
    Conductor{"Titanium", {1.9345, 1.86761, 2.05863}, {2.33987, 2.05312, 1.74518}, "main/Ti/Palm"},
    Conductor{"Tungsten", {3.8332, 3.92528, 4.53149}, {3.26472, 3.0739, 2.0965}, "main/W/Werner-DFT"},
    Conductor{"Vanadium", {3.6507, 3.72723, 4.94609}, {3.25065, 3.00712, 2.17896}, "main/V/Werner-DFT"},
    Conductor{"Zinc", {3.15207, 1.89133, 1.48736}, {7.39342, 6.28678, 4.92701}, "main/Zn/Werner-DFT"},
};

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

std::span<const Conductor> measured_conductors() { return kConductors; }
std::span<const Dielectric> measured_dielectrics() { return kDielectrics; }

}  // namespace remapc
