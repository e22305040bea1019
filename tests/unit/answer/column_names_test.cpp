#include "answer/column_names.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/options.h"

namespace rsphere {
namespace {

std::vector<std::string> namesOf(const std::vector<std::string>& words, size_t contributors = 0) {
  std::vector<std::string> line{"rsphere"};
  line.insert(line.end(), words.begin(), words.end());
  line.emplace_back("scene.rad");
  Options options = parseOptions(line);
  options.contributors.resize(contributors, "lamp");
  std::vector<std::string> names;
  for (const auto& ofLetter : columnNames(options))
    names.insert(names.end(), ofLetter.begin(), ofLetter.end());
  return names;
}

using Names = std::vector<std::string>;

TEST(ColumnNames, AreOneForEachColumn) {
  EXPECT_EQ(namesOf({"-ove"}),
            (Names{"mean_radiance_r", "mean_radiance_g", "mean_radiance_b", "mean_radiance_error_r",
                   "mean_radiance_error_g", "mean_radiance_error_b"}));
  EXPECT_EQ(namesOf({"-pY", "-oEeuk"}),
            (Names{"scalar_irradiance", "scalar_irradiance_error", "light_vector_x", "light_vector_y",
                   "light_vector_z", "directions"}));
  EXPECT_EQ(namesOf({"-pY", "-oHe"})[4], "six_irradiances_+z");
  EXPECT_EQ(namesOf({"-pY", "-oHe"})[10], "six_irradiances_error_+z");
  EXPECT_EQ(namesOf({"-pY", "-Sz", "3", "-ozZ"})[4], "zones_error_2");
  EXPECT_EQ(namesOf({"-pY", "-Sp", "-ov"}, 2), (Names{"mean_radiance.1", "mean_radiance.2"}));
  EXPECT_EQ(namesOf({"-cs", "6", "-co", "-ov"})[5], "mean_radiance_6");
  EXPECT_EQ(namesOf({"-S-", "-pXYZ", "-ovcL"}),
            (Names{"value_X", "value_Y", "value_Z", "local_u", "local_v", "first_length"}));
  EXPECT_EQ(namesOf({"-S-", "-odpsm"}).size(), 8u);
  EXPECT_EQ(namesOf({"-Su", "-odug"}).back(), "DGP");
  EXPECT_EQ(namesOf({"-Sd", "-pY", "-odwv"}),
            (Names{"direction_x", "direction_y", "direction_z", "weight", "value"}));
}

}  // namespace
}  // namespace rsphere
