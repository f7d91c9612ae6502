// SPDX-License-Identifier: MIT
// A body as a model of FEBio: the whole text of a small one, written by hand after FEBio's manual, and the constants of each law.
#include "risorius/softbody/feb_text.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "message_of.h"
#include "temporary_folder.h"

namespace risorius::softbody {
namespace {

class FebText : public testing::Test {
  protected:
    FebText() {
        std::ofstream(folder_ / "two.mesh")
            << "MeshVersionFormatted 2\nDimension 3\nVertices\n5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 "
               "0\n1 1 1.5 0\nTetrahedra\n2\n1 2 3 4 7\n2 3 4 5 9\nEnd\n";
    }
    std::string text(const std::string& materials, const std::string& more = "{}") const {
        Json json = Json::parse(more);
        json["kind"] = "mesh";
        json["mesh"] = Json{{"file", (folder_ / "two.mesh").string()}, {"metres_per_unit", 0.5}};
        json["materials"] = Json::parse(materials);
        return feb_text(read_mesh_body(JsonCursor::from_json(json, "body")));
    }
    TemporaryFolder folder_;
};

TEST_F(FebText, IsAWholeModel) {
    const std::string expected = R"(<?xml version="1.0" encoding="UTF-8"?>
<febio_spec version="4.0">
	<Module type="solid" />
	<Control>
		<analysis>STATIC</analysis>
		<time_steps>10</time_steps>
		<step_size>0.1</step_size>
		<solver type="solid">
			<symmetric_stiffness>symmetric</symmetric_stiffness>
		</solver>
	</Control>
	<Material>
		<material id="1" name="material1" type="trans iso Mooney-Rivlin">
			<density>1040</density>
			<k>50000</k>
			<pressure_model>2</pressure_model>
			<c1>500</c1>
			<c2>0</c2>
			<c3>150</c3>
			<c4>6.6</c4>
			<c5>15000</c5>
			<lam_max>1.4</lam_max>
			<fiber type="vector">
				<vector>0,0,1</vector>
			</fiber>
		</material>
		<material id="2" name="material2" type="Mooney-Rivlin">
			<density>1000</density>
			<k>40000</k>
			<pressure_model>2</pressure_model>
			<c1>300</c1>
			<c2>100</c2>
		</material>
	</Material>
	<Mesh>
		<Nodes name="body">
			<node id="1">0,0,0</node>
			<node id="2">0.5,0,0</node>
			<node id="3">0,0.5,0</node>
			<node id="4">0,0,0.5</node>
			<node id="5">0.5,0.5,0.75</node>
		</Nodes>
		<Elements type="tet4" name="part1">
			<elem id="1">2,3,4,5</elem>
		</Elements>
		<Elements type="tet4" name="part2">
			<elem id="2">1,2,3,4</elem>
		</Elements>
		<NodeSet name="fixed">1,2,3</NodeSet>
	</Mesh>
	<MeshDomains>
		<SolidDomain name="part1" mat="material1" />
		<SolidDomain name="part2" mat="material2" />
	</MeshDomains>
	<Boundary>
		<bc name="fixed" node_set="fixed" type="zero displacement">
			<x_dof>1</x_dof>
			<y_dof>1</y_dof>
			<z_dof>1</z_dof>
		</bc>
	</Boundary>
	<Loads>
		<body_load name="weight" type="body force">
			<force lc="1" type="vector">0,0,9.81</force>
		</body_load>
	</Loads>
	<LoadData>
		<load_controller id="1" type="loadcurve">
			<interpolate>LINEAR</interpolate>
			<points>
				<pt>0,0</pt>
				<pt>1,1</pt>
			</points>
		</load_controller>
	</LoadData>
	<Output>
		<plotfile type="febio">
			<var type="displacement" />
			<var type="stress" />
		</plotfile>
	</Output>
</febio_spec>
)";
    EXPECT_EQ(text(R"([{"tags": [9], "law": "fibres", "c10_pa": 500, "bulk_pa": 50000,
                        "density_kg_per_m3": 1040, "c3_pa": 150, "c4": 6.6, "c5_pa": 15000,
                        "straight": 1.4, "along": [0, 0, 2]},
                       {"law": "mooney-rivlin", "c10_pa": 300, "c01_pa": 100, "bulk_pa": 40000,
                        "density_kg_per_m3": 1000}])",
                   R"({"fixed": [{"low_m": [-1, -1, -1], "high_m": [1, 1, 0]}]})"),
              expected);
}

// W = m / a (..) here, c / m^2 (..) there: c = m a. With a = 2 it is neo-Hookean of c10 = c / 4.
TEST_F(FebText, OgdenHasTheConstantsOfFebio) {
    const std::string found =
        text(R"([{"law": "ogden", "terms": [[300, 2], [-50, -2]], "bulk_pa": 40000,
                  "density_kg_per_m3": 1000}])",
             R"({"gravity_m_per_s2": [0, 0, 0]})");
    for (const char* line : {"type=\"Ogden\"", "<c1>600</c1>", "<m1>2</m1>", "<c2>100</c2>",
                             "<m2>-2</m2>", "<c3>0</c3>", "<c6>0</c6>"})
        EXPECT_NE(found.find(line), std::string::npos) << line;
    for (const char* tag : {"<Loads>", "<Boundary>", "<NodeSet", "<LoadData>"})
        EXPECT_EQ(found.find(tag), std::string::npos) << tag;
    const std::string seven =
        R"([{"law": "ogden", "terms": [[1, 1], [1, 2], [1, 3], [1, 4], [1, 5], [1, 6], [1, 7]],
            "bulk_pa": 40000, "density_kg_per_m3": 1000}])";
    EXPECT_EQ(message_of([&] { text(seven); }),
              "body:/materials/0/terms: expected at most 6 terms, as FEBio has, found 7");
}

}  // namespace
}  // namespace risorius::softbody
