// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Reads what rsackermann_export writes as the tools that it is for do (doc/exports.md) and compares with the renderer's
// truth.

#include "program.hpp"
#include "camera_settings.hpp"
#include "gyro_file.hpp"
#include "street_model.hpp"
#include "truth_file.hpp"

#include <sstream>

namespace opencv_test { namespace {

using nlohmann::json;
using rsackermann_samples::Truth;

//! Replaces results, as most tests write the same ones several times.
Outcome exportMotion(const Arguments& arguments)
{
    return runProgram(EXPORT_PROGRAM, arguments + Arguments{"--overwrite"});
}

// A street with its true motion in a file.
class Export : public testing::Test
{
public:
    Export()
        : truth(rsackermann_samples::readTruth(streetFolder() + "/truth.json")), renderer(truth.camera, truth.scene)
    {
        writeMotion();
    }

    void writeMotion()
    {
        cv::FileStorage fs(folder / "motion.yml", cv::FileStorage::WRITE);
        fs.write("input", std::string("street/rolling.png"));
        fs.startWriteStruct("motion", cv::FileNode::MAP);
        rsackermann_samples::libraryMotion(truth.camera, truth.scene).write(fs);
        fs.endWriteStruct();
    }

    void write(const Arguments& options)
    {
        Arguments all = {"--motion=" + (folder / "motion.yml"), "--camera=" + streetFolder() + "/camera.yml"};
        all.insert(all.end(), options.begin(), options.end());
        const Outcome outcome = exportMotion(all);
        ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    }

    cv::Size size() const { return truth.camera.size; }

    TemporaryFolder folder;
    Truth truth;
    street::StreetRenderer renderer;
};

//! Of rsackermann_correct, with the true motion.
json lineOfReport(const Truth& truth, const std::string& input)
{
    const cv::rsackermann::AckermannMotion m = rsackermann_samples::libraryMotion(truth.camera, truth.scene);
    return {{"input", input},
            {"status", "ok"},
            {"alpha", m.alpha},
            {"beta", m.wallSlope},
            {"wall_offset", m.wallOffset},
            {"wall_ratio", m.wallRatio},
            {"road_slope", m.roadSlope},
            {"direction", m.direction},
            {"roll_correction_deg", 0},
            {"pitch_correction_deg", 0},
            {"wall_distance_m", m.wallDistance},
            {"scale", "wall"}};
}

typedef cv::Matx44d Pose;

Pose poseOf(const json& rows)
{
    Pose pose;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            pose(i, j) = rows.at(i).at(j);
    return pose;
}

// The camera drives on a circle, which the chord cuts at half of the yaw to the reference.
Pose viewAt(const Truth& truth, double row)
{
    const double time = (row - truth.camera.reference) * truth.camera.lineDelay, yaw = truth.scene.yawRate * time;
    const double chord =
        std::abs(yaw) > 1e-12 ? truth.scene.speed * time * std::sin(yaw / 2) / (yaw / 2) : truth.scene.speed * time;
    const cv::Vec3d position(chord * std::sin(yaw / 2), 0, chord * std::cos(yaw / 2));
    const cv::Matx33d toCamera(std::cos(yaw), 0, -std::sin(yaw), 0, 1, 0, std::sin(yaw), 0, std::cos(yaw));
    const cv::Vec3d t = -(toCamera * position);
    Pose pose = Pose::eye();
    for (int i = 0; i < 3; i++)
    {
        for (int j = 0; j < 3; j++)
            pose(i, j) = toCamera(i, j);
        pose(i, 3) = t[i];
    }
    return pose;
}

TEST_F(Export, row_poses_are_the_views_at_the_first_and_the_last_line)
{
    write({"--row_poses=" + (folder / "poses.json")});
    const json poses = json::parse(contentOf(folder / "poses.json"));
    EXPECT_EQ(size().width, poses["width"]);
    EXPECT_EQ(size().height, poses["height"]);
    EXPECT_EQ("ROLLING_TOP_TO_BOTTOM", poses["shutter"]);
    EXPECT_NEAR(truth.camera.lineDelay, poses["line_delay_s"].get<double>(), 1e-12);
    EXPECT_EQ(0, poses["start_line"]);
    EXPECT_EQ(size().height - 1, poses["end_line"]);
    ASSERT_EQ(1u, poses["frames"].size());
    const json& frame = poses["frames"][0];
    EXPECT_EQ("rolling.png", frame["file"]);
    EXPECT_EQ(true, frame["moves"]);
    EXPECT_EQ("metre", frame["unit"]);
    EXPECT_LT(cv::norm(poseOf(frame["viewmat_start"]) - viewAt(truth, 0)), 1e-9);
    EXPECT_LT(cv::norm(poseOf(frame["viewmat_end"]) - viewAt(truth, size().height - 1)), 1e-9);
    EXPECT_GT(cv::norm(poseOf(frame["viewmat_end"]) - poseOf(frame["viewmat_start"])), 0.1);
    EXPECT_FALSE(frame.contains("viewmats")); // one straight way
}

TEST_F(Export, row_poses_on_a_road_without_walls)
{
    truth.scene.left = truth.scene.right = 0;
    for (const double direction : {1, -1})
    {
        SCOPED_TRACE(direction);
        truth.scene.speed *= direction;
        writeMotion();
        write({"--row_poses=" + (folder / "poses.json")});
        const json poses = json::parse(contentOf(folder / "poses.json"));
        const json& frame = poses["frames"][0];
        EXPECT_EQ("metre", frame["unit"]);
        EXPECT_LT(cv::norm(poseOf(frame["viewmat_start"]) - viewAt(truth, 0)), 1e-9);
        EXPECT_LT(cv::norm(poseOf(frame["viewmat_end"]) - viewAt(truth, size().height - 1)), 1e-9);
    }
}

TEST_F(Export, row_poses_of_each_shutter)
{
    const struct
    {
        const char *scan, *shutter;
        bool isByColumns, isBackward;
    } cases[] = {{"top_to_bottom", "ROLLING_TOP_TO_BOTTOM", false, false},
                 {"bottom_to_top", "ROLLING_BOTTOM_TO_TOP", false, true},
                 {"left_to_right", "ROLLING_LEFT_TO_RIGHT", true, false},
                 {"right_to_left", "ROLLING_RIGHT_TO_LEFT", true, true}};
    for (const auto& c : cases)
    {
        SCOPED_TRACE(c.scan);
        write({"--row_poses=" + (folder / "poses.json"), std::string("--scan=") + c.scan});
        const json poses = json::parse(contentOf(folder / "poses.json"));
        const int last = (c.isByColumns ? size().width : size().height) - 1;
        EXPECT_EQ(c.shutter, poses["shutter"]);
        EXPECT_EQ(c.isBackward ? last : 0, poses["start_line"]);
        EXPECT_EQ(c.isBackward ? 0 : last, poses["end_line"]);
        // Backward the last line is read as much before the reference as the first one is read after it.
        const double before = poses["reference_line"].get<double>(), after = last - before,
                     first = truth.camera.reference - (c.isBackward ? after : before);
        const json& frame = poses["frames"][0];
        EXPECT_LT(cv::norm(poseOf(frame["viewmat_start"]) - viewAt(truth, first)), 1e-9);
        EXPECT_LT(cv::norm(poseOf(frame["viewmat_end"]) - viewAt(truth, first + last)), 1e-9);
    }
}

// An engine turns rows to and fro while they are read: each line is where it truly is between two of the poses.
TEST_F(Export, row_poses_of_rows_that_shake)
{
    const double amplitude = 0.003; // radians about the x axis: 2.4 pixels
    const auto angleAt = [&](double line) { return amplitude * std::sin(3 * CV_PI * line / (size().height - 1)); };
    cv::rsackermann::AckermannMotion motion = rsackermann_samples::libraryMotion(truth.camera, truth.scene);
    motion.rotationCurve = cv::Mat::zeros(17, 3, CV_64F);
    for (int i = 0; i < 17; i++)
        motion.rotationCurve.at<double>(i, 0) = angleAt((size().height - 1) * i / 16.);
    {
        cv::FileStorage fs(folder / "motion.yml", cv::FileStorage::WRITE);
        motion.write(fs);
    }
    for (const bool isBackward : {false, true})
    {
        SCOPED_TRACE(isBackward);
        write({"--row_poses=" + (folder / "poses.json"),
               std::string("--scan=") + (isBackward ? "bottom_to_top" : "top_to_bottom")});
        const json poses = json::parse(contentOf(folder / "poses.json")), frame = poses["frames"][0],
                   views = frame["viewmats"];
        ASSERT_GE(views.size(), 17u);
        EXPECT_LE(views.size(), 65u);
        EXPECT_EQ(poses["start_line"], views.front()["line"]);
        EXPECT_EQ(frame["viewmat_start"], views.front()["viewmat"]);
        EXPECT_EQ(poses["end_line"], views.back()["line"]);
        EXPECT_EQ(frame["viewmat_end"], views.back()["viewmat"]);
        const double first = views.front()["line"], step = views[1]["line"].get<double>() - first;
        double largest = 0;
        for (int line = 0; line < size().height; line++)
        {
            const double place = (line - first) / step;
            const size_t i = std::min(size_t(place), views.size() - 2);
            const Pose between =
                poseOf(views[i]["viewmat"]) * (1 - (place - i)) + poseOf(views[i + 1]["viewmat"]) * (place - i);
            const double sign = isBackward ? -1 : 1, reference = poses["reference_line"];
            const double c = std::cos(angleAt(line)), s = std::sin(angleAt(line));
            const cv::Matx33d turn(1, 0, 0, 0, c, s, 0, -s, c);
            const Pose steady = viewAt(truth, truth.camera.reference + sign * (line - reference));
            for (const cv::Vec4d& point : {cv::Vec4d(-2, -1, 5, 1), cv::Vec4d(0, 1, 7, 1), cv::Vec4d(2, 0, 5, 1)})
            {
                const cv::Vec4d got = between * point, level = steady * point;
                const cv::Vec3d exact = turn * cv::Vec3d(level[0], level[1], level[2]);
                largest = std::max(largest, truth.camera.fx * std::hypot(got[0] / got[2] - exact[0] / exact[2],
                                                                         got[1] / got[2] - exact[1] / exact[2]));
            }
        }
        EXPECT_LT(largest, 0.05);
    }
}

// https://colmap.github.io/format.html: pixel centres at 0.5; masks are named after their image, and 0 stands for no
// features.
TEST_F(Export, colmap_camera_and_masks)
{
    write({"--colmap=" + (folder / "colmap")});
    std::vector<std::string> cameras;
    for (const std::string& line : linesOf(folder / "colmap/cameras.txt"))
        if (!line.empty() && line[0] != '#')
            cameras.push_back(line);
    ASSERT_EQ(1u, cameras.size());
    std::istringstream words(cameras[0]);
    int id = 0;
    std::string model;
    cv::Size colmapSize;
    double fx = 0, fy = 0, cx = 0, cy = 0;
    words >> id >> model >> colmapSize.width >> colmapSize.height >> fx >> fy >> cx >> cy;
    ASSERT_FALSE(words.fail());
    EXPECT_TRUE((words >> std::ws).eof());
    EXPECT_EQ("PINHOLE", model);
    EXPECT_EQ(size(), colmapSize);
    EXPECT_NEAR(truth.camera.fx, fx, 1e-9);
    EXPECT_NEAR(truth.camera.fy, fy, 1e-9);
    EXPECT_NEAR(truth.camera.cx + 0.5, cx, 1e-9);
    EXPECT_NEAR(truth.camera.cy + 0.5, cy, 1e-9);

    const cv::Mat mask = cv::imread(folder / "colmap/masks/rolling.png.png", cv::IMREAD_UNCHANGED);
    ASSERT_EQ(CV_8UC1, mask.type());
    ASSERT_EQ(size(), mask.size());
    cv::Mat columns, rows, seen;
    renderer.rectifyMap(columns, rows, seen);
    EXPECT_LT(cv::countNonZero(seen), int(seen.total()));
    // Pixels that are seen at the very border may round either way.
    EXPECT_LE(cv::countNonZero(mask != seen), size().width + size().height);
}

// Applies an STMap as Nuke's node of this name: shares of the source's size from its lower left corner, at the pixel's
// centre.
cv::Point2d placeOf(const cv::Mat& map, int x, int y, const cv::Size& source, double full)
{
    double u = 0, v = 0;
    if (map.depth() == CV_16U)
    {
        u = map.at<cv::Vec3w>(y, x)[2] / full;
        v = map.at<cv::Vec3w>(y, x)[1] / full;
    }
    else
    {
        u = map.at<cv::Vec3f>(y, x)[2] / full;
        v = map.at<cv::Vec3f>(y, x)[1] / full;
    }
    return cv::Point2d(u * source.width - 0.5, (1 - v) * source.height - 0.5);
}

typedef bool (street::StreetRenderer::*Move)(const cv::Point2d& from, cv::Point2d& to) const;

void expectMoves(Move move, const cv::Mat& map, const street::StreetRenderer& renderer, double full, double tolerance)
{
    int compared = 0;
    for (int y = 0; y < map.rows; y += 7)
        for (int x = 0; x < map.cols; x += 7)
        {
            cv::Point2d exact;
            const bool inside = (renderer.*move)(cv::Point2d(x, y), exact) && exact.x >= 0 && exact.y >= 0 &&
                                exact.x <= map.cols - 1 && exact.y <= map.rows - 1;
            if (!inside)
                continue;
            compared++;
            ASSERT_LT(cv::norm(placeOf(map, x, y, map.size(), full) - exact), tolerance) << x << ", " << y;
        }
    EXPECT_GT(compared, 1000);
}

// A step of the 16 bits is 0.01 pixels of this width.
TEST_F(Export, stmap_of_16_bits)
{
    write({"--stmap=" + (folder / "maps")});
    const cv::Mat rectify = cv::imread(folder / "maps/rolling.png.rectify.png", cv::IMREAD_UNCHANGED);
    const cv::Mat distort = cv::imread(folder / "maps/rolling.png.distort.png", cv::IMREAD_UNCHANGED);
    ASSERT_EQ(CV_16UC3, rectify.type());
    ASSERT_EQ(CV_16UC3, distort.type());
    expectMoves(&street::StreetRenderer::toRolling, rectify, renderer, 65535, 0.02);
    expectMoves(&street::StreetRenderer::toGlobal, distort, renderer, 65535, 0.02);
    // Blue tells whether there is a place in the image.
    cv::Mat columns, rows, seen, blue;
    renderer.rectifyMap(columns, rows, seen);
    cv::extractChannel(rectify, blue, 0);
    EXPECT_LE(cv::countNonZero((blue == 65535) != seen), size().width + size().height);
    EXPECT_EQ(0, cv::countNonZero((blue != 65535) & (blue != 0)));
}

TEST_F(Export, stmap_of_floats)
{
    write({"--stmap=" + (folder / "maps"), "--stmap_format=exr"});
    const cv::Mat rectify = cv::imread(folder / "maps/rolling.png.rectify.exr", cv::IMREAD_UNCHANGED);
    const cv::Mat distort = cv::imread(folder / "maps/rolling.png.distort.exr", cv::IMREAD_UNCHANGED);
    ASSERT_EQ(CV_32FC3, rectify.type());
    ASSERT_EQ(CV_32FC3, distort.type());
    expectMoves(&street::StreetRenderer::toRolling, rectify, renderer, 1, 2e-3);
    expectMoves(&street::StreetRenderer::toGlobal, distort, renderer, 1, 2e-3);
}

TEST_F(Export, tracks_keep_their_other_columns)
{
    // Points of the corrected image and their places in the raw one.
    const std::vector<cv::Point2d> points = {{100, 80}, {320, 300}, {500.25, 200.5}, {40, 350}};
    std::string table = "track,x,\"a note, quoted\",y\r\n";
    for (size_t i = 0; i < points.size(); i++)
    {
        cv::Point2d raw;
        ASSERT_TRUE(renderer.toRolling(points[i], raw));
        table += cv::format("%d,%.9f,n%d,%.9f\r\n", int(10 + i), raw.x, int(i), raw.y);
    }
    writeContent(folder / "tracks.csv", table);
    write({"--tracks=" + (folder / "tracks.csv"), "--tracks_output=" + (folder / "corrected.csv")});
    const std::vector<std::string> lines = linesOf(folder / "corrected.csv");
    ASSERT_EQ(1 + points.size(), lines.size());
    EXPECT_EQ("track,x,\"a note, quoted\",y", lines[0]);
    for (size_t i = 0; i < points.size(); i++)
    {
        int track = -1, note = -1;
        double x = 0, y = 0;
        ASSERT_EQ(4, std::sscanf(lines[1 + i].c_str(), "%d,%lf,n%d,%lf", &track, &x, &note, &y)) << lines[1 + i];
        EXPECT_EQ(int(10 + i), track);
        EXPECT_EQ(int(i), note);
        EXPECT_LT(cv::norm(cv::Point2d(x, y) - points[i]), 1e-3);
    }
}

TEST_F(Export, damaged_tracks_are_refused_with_their_line)
{
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"x,z\n1,2\n", "a header with x and y"},
        {"x,y\n1,2\n1,2,3\n", "line 3"},
        {"x,y\n1,abc\n", "line 2"},
        {"x,y\n1,0x2\n", "line 2 of " + (folder / "tracks.csv") + ", column y: '0x2'"},
        {"x,y,x\n1,2,3\n", "column 3"}, // which of both is one?
        {"file,x,y\nother.png,1,2\n", "no motion of the file other.png"},
        {"", "tracks.csv"}};
    for (const auto& c : cases)
    {
        writeContent(folder / "tracks.csv", c.first);
        const Outcome outcome =
            exportMotion({"--motion=" + (folder / "motion.yml"), "--camera=" + streetFolder() + "/camera.yml",
                          "--tracks=" + (folder / "tracks.csv"), "--tracks_output=" + (folder / "out.csv")});
        EXPECT_NE(0, outcome.exitCode) << c.first;
        EXPECT_NE(std::string::npos, outcome.messages.find(c.second)) << outcome.messages;
        EXPECT_FALSE(cv::utils::fs::exists(folder / "out.csv"));
    }
}

// The place of a point in the row that sees it; false if it is behind or the image doesn't show it.
bool placeInRaw(const Truth& truth, const cv::Vec3d& point, cv::Point2d& place, double roll = 0)
{
    const double c = std::cos(roll), s = std::sin(roll);
    const Pose upright(c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    place.y = truth.camera.reference;
    for (int i = 0; i < 100; i++)
    {
        const cv::Vec4d seen =
            upright.t() * viewAt(truth, place.y) * upright * cv::Vec4d(point[0], point[1], point[2], 1);
        if (seen[2] <= 0)
            return false;
        place = cv::Point2d(truth.camera.cx + truth.camera.fx * seen[0] / seen[2],
                            truth.camera.cy + truth.camera.fy * seen[1] / seen[2]);
    }
    return place.x >= -0.5 && place.y >= -0.5 && place.x <= truth.camera.size.width - 0.5 &&
           place.y <= truth.camera.size.height - 0.5;
}

TEST_F(Export, points_of_a_lidar_are_where_their_row_sees_them)
{
    cv::RNG rng(1);
    std::vector<cv::Vec3d> points;
    std::string table = "ring,x,y,z\n";
    for (int i = 0; i < 1000; i++)
    {
        const double z = rng.uniform(-5., 40.);
        points.push_back(cv::Vec3d(rng.uniform(-20., 20.), rng.uniform(-5., 3.), z));
        table += cv::format("r%d,%.17g,%.17g,%.17g\n", i % 64, points[size_t(i)][0], points[size_t(i)][1], z);
    }
    writeContent(folder / "cloud.csv", table);
    write({"--points=" + (folder / "cloud.csv"), "--points_output=" + (folder / "places.csv")});
    const std::vector<std::string> lines = linesOf(folder / "places.csv"), read = linesOf(folder / "cloud.csv");
    ASSERT_EQ(1 + points.size(), lines.size());
    EXPECT_EQ("ring,x,y,z,u,v", lines[0]);
    int seen = 0;
    double farthest = 0;
    for (size_t i = 0; i < points.size(); i++)
    {
        cv::Point2d exact, place;
        if (!placeInRaw(truth, points[i], exact))
        {
            EXPECT_EQ(read[1 + i] + ",,", lines[1 + i]);
            continue;
        }
        seen++;
        ASSERT_EQ(read[1 + i] + ",", lines[1 + i].substr(0, read[1 + i].size() + 1));
        ASSERT_EQ(2, std::sscanf(lines[1 + i].c_str() + read[1 + i].size(), ",%lf,%lf", &place.x, &place.y));
        EXPECT_LT(cv::norm(place - exact), 1e-6);
        const cv::Point2d global(truth.camera.cx + truth.camera.fx * points[i][0] / points[i][2],
                                 truth.camera.cy + truth.camera.fy * points[i][1] / points[i][2]);
        farthest = std::max(farthest, cv::norm(place - global));
    }
    EXPECT_GT(seen, 200);
    EXPECT_LT(seen, 800);
    EXPECT_GT(farthest, 5);
}

TEST_F(Export, points_of_several_frames)
{
    const std::string still = "{\"input\": \"still.png\", \"status\": \"not_significant\"}\n";
    // Of a frame that is there twice the last line counts.
    const std::string before = lineOfReport(truth, "still.png").dump() + "\n";
    writeContent(folder / "report.jsonl",
                 before + still + "{\"input\": \"other.png\", \"status\": \"no_consensus\"}\n");
    const Arguments arguments = {"--report=" + (folder / "report.jsonl"), "--camera=" + streetFolder() + "/camera.yml",
                                 "--points=" + (folder / "cloud.csv"), "--points_output=" + (folder / "places.csv")};
    writeContent(folder / "cloud.csv", "file,x,y,z\nother.png,0,0,7\nstill.png,1,0.5,10\nstill.png,1,1,0\n"
                                       "still.png,1,0.5,-10\n");
    ASSERT_EQ(0, exportMotion(arguments).exitCode);
    const std::vector<std::string> lines = linesOf(folder / "places.csv");
    ASSERT_EQ(5u, lines.size());
    EXPECT_EQ(cv::format("other.png,0,0,7,%.6f,%.6f", truth.camera.cx, truth.camera.cy), lines[1]);
    EXPECT_EQ(cv::format("still.png,1,0.5,10,%.6f,%.6f", truth.camera.cx + truth.camera.fx / 10,
                         truth.camera.cy + truth.camera.fy / 20),
              lines[2]);
    EXPECT_EQ("still.png,1,1,0,,", lines[3]);
    EXPECT_EQ("still.png,1,0.5,-10,,", lines[4]);

    const std::pair<const char*, const char*> damaged[] = {
        {"x,y,z\n1,2,3\n", "a header with x, y, z and file"},
        {"file,x,y,z,u\n", "there is a column u already"},
        {"file,x,y,z\nstill.png,1,,3\n", "cloud.csv, column y"},
        {"file,x,y,z\nthird.png,1,2,3\n", "no motion of the file third.png"}};
    for (const std::pair<const char*, const char*>& table : damaged)
    {
        writeContent(folder / "cloud.csv", table.first);
        const Outcome outcome = exportMotion(arguments);
        EXPECT_EQ(1, outcome.exitCode) << table.first;
        EXPECT_NE(std::string::npos, outcome.messages.find(table.second)) << outcome.messages;
    }
}

// Each as its line of the report says.
TEST_F(Export, points_and_tracks_of_frames_that_lean)
{
    std::string report, cloud = "file,x,y,z\n", tracks = "file,x,y,depth\n";
    const double rolls[] = {0, 20, -35}; // degrees
    const cv::Vec3d point(1, 0.5, 6);
    for (const double roll : rolls)
    {
        json line = lineOfReport(truth, cv::format("%g.png", roll));
        line["roll_deg"] = roll;
        line["pitch_deg"] = 0;
        report += line.dump() + "\n";
        cloud += cv::format("%g.png,%g,%g,%g\n", roll, point[0], point[1], point[2]);
        cv::Point2d raw;
        ASSERT_TRUE(placeInRaw(truth, point, raw, roll * CV_PI / 180));
        tracks += cv::format("%g.png,%.9f,%.9f,%g\n", roll, raw.x, raw.y, point[2]);
    }
    writeContent(folder / "report.jsonl", report);
    writeContent(folder / "cloud.csv", cloud);
    writeContent(folder / "tracks.csv", tracks);
    const Outcome outcome =
        exportMotion({"--report=" + (folder / "report.jsonl"), "--camera=" + streetFolder() + "/camera.yml",
                      "--points=" + (folder / "cloud.csv"), "--points_output=" + (folder / "places.csv"),
                      "--tracks=" + (folder / "tracks.csv"), "--tracks_output=" + (folder / "corrected.csv")});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    const std::vector<std::string> lines = linesOf(folder / "places.csv"),
                                   corrected = linesOf(folder / "corrected.csv");
    ASSERT_EQ(4u, lines.size());
    ASSERT_EQ(4u, corrected.size());
    const cv::Point2d global(truth.camera.cx + truth.camera.fx * point[0] / point[2],
                             truth.camera.cy + truth.camera.fy * point[1] / point[2]);
    cv::Point2d exact, place, level;
    ASSERT_TRUE(placeInRaw(truth, point, level));
    for (int i = 0; i < 3; i++)
    {
        ASSERT_TRUE(placeInRaw(truth, point, exact, rolls[i] * CV_PI / 180));
        ASSERT_EQ(2, std::sscanf(lines[size_t(i) + 1].c_str(), "%*[^,],%*f,%*f,%*f,%lf,%lf", &place.x, &place.y));
        EXPECT_LT(cv::norm(place - exact), 1e-5) << rolls[i];
        EXPECT_EQ(i > 0, cv::norm(exact - level) > 0.1);
        ASSERT_EQ(2, std::sscanf(corrected[size_t(i) + 1].c_str(), "%*[^,],%lf,%lf", &place.x, &place.y));
        EXPECT_LT(cv::norm(place - global), 1e-5) << rolls[i];
    }
}

TEST_F(Export, points_need_metres)
{
    cv::rsackermann::AckermannMotion motion = rsackermann_samples::libraryMotion(truth.camera, truth.scene);
    motion.wallDistance = 0;
    motion.scale = cv::rsackermann::SCALE_UNKNOWN;
    {
        cv::FileStorage fs(folder / "motion.yml", cv::FileStorage::WRITE);
        fs.write("input", std::string("street.png"));
        motion.write(fs);
    }
    writeContent(folder / "cloud.csv", "x,y,z\n1,2,3\n");
    writeContent(folder / "tracks.csv", "x,y,depth\n100,200,3\n");
    const Arguments given = {"--motion=" + (folder / "motion.yml"), "--camera=" + streetFolder() + "/camera.yml"};
    for (const std::string table : {"points", "tracks"})
    {
        Arguments arguments = given;
        arguments.push_back("--" + table + "=" + (folder / (table == "points" ? "cloud.csv" : "tracks.csv")));
        arguments.push_back("--" + table + "_output=" + (folder / "places.csv"));
        const Outcome outcome = exportMotion(arguments);
        EXPECT_EQ(1, outcome.exitCode);
        EXPECT_NE(std::string::npos, outcome.messages.find("street.png: ")) << outcome.messages;
        EXPECT_NE(std::string::npos, outcome.messages.find("--speed, --wall or --scale_from_road")) << outcome.messages;
        EXPECT_FALSE(cv::utils::fs::exists(folder / "places.csv"));
    }
}

// The mesh as a warper takes it: the four nodes around a pixel, bilinear.
TEST_F(Export, mesh_has_the_error_that_it_says)
{
    double coarse = 0;
    for (const int columns : {9, 33})
    {
        const int rows = columns * 2 / 3;
        write({"--mesh=" + (folder / "mesh.json"), cv::format("--mesh_size=%dx%d", columns, rows)});
        const json mesh = json::parse(contentOf(folder / "mesh.json"));
        EXPECT_EQ(columns, mesh["columns"]);
        EXPECT_EQ(rows, mesh["rows"]);
        const json& frame = mesh["frames"][0];
        const json& nodes = frame["nodes"];
        ASSERT_EQ(size_t(columns * rows), nodes.size());
        EXPECT_EQ(json({0, 0}), json({nodes[0][0], nodes[0][1]}));
        EXPECT_EQ(json({639, 379}), json({nodes.back()[0], nodes.back()[1]}));

        double sum = 0, largest = 0;
        int compared = 0;
        for (int j = 0; j + 1 < rows; j++)
            for (int i = 0; i + 1 < columns; i++)
            {
                const json corners[] = {nodes[j * columns + i], nodes[j * columns + i + 1],
                                        nodes[(j + 1) * columns + i], nodes[(j + 1) * columns + i + 1]};
                const cv::Point2d low(corners[0][0], corners[0][1]), high(corners[3][0], corners[3][1]);
                for (int y = int(std::ceil(low.y)); y < high.y; y++)
                    for (int x = int(std::ceil(low.x)); x < high.x; x++)
                    {
                        cv::Point2d exact, place;
                        if (!renderer.toRolling(cv::Point2d(x, y), exact) || exact.x < 0 || exact.y < 0 ||
                            exact.x > 639 || exact.y > 379)
                            continue;
                        const double u = (x - low.x) / (high.x - low.x), v = (y - low.y) / (high.y - low.y);
                        const double weights[] = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
                        for (int k = 0; k < 4; k++)
                            place += weights[k] * cv::Point2d(corners[k][2], corners[k][3]);
                        const double error = cv::norm(place - exact);
                        largest = std::max(largest, error);
                        sum += error * error;
                        compared++;
                    }
            }
        ASSERT_GT(compared, 100000);
        EXPECT_NEAR(largest, frame["max_error_px"].get<double>(), 5e-3);
        EXPECT_NEAR(std::sqrt(sum / compared), frame["rms_error_px"].get<double>(), 1e-3);
        if (coarse > 0)
        {
            EXPECT_LT(frame["rms_error_px"].get<double>(), coarse / 3);
        }
        coarse = frame["rms_error_px"];
    }
}

// A report has what the file of a motion has.
TEST_F(Export, report)
{
    const json street = lineOfReport(truth, "street/rolling.png");
    json frame = street;
    frame["input"] = "drive.mp4";
    frame["frame"] = 7;
    const json failed = {{"input", "x.png"}, {"status", "failed"}, {"error", "the image can't be decoded"}};
    const json still = {{"input", "still.png"}, {"status", "not_significant"}, {"alpha", nullptr}};
    writeContent(folder / "report.jsonl",
                 street.dump() + "\n" + failed.dump() + "\n" + still.dump() + "\n" + frame.dump() + "\n");
    const std::string camera = "--camera=" + streetFolder() + "/camera.yml";
    const Outcome outcome =
        exportMotion({"--report=" + (folder / "report.jsonl"), camera, "--row_poses=" + (folder / "of_report.json")});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    write({"--row_poses=" + (folder / "of_motion.json")});
    const json expected = json::parse(contentOf(folder / "of_motion.json"))["frames"][0];
    const json frames = json::parse(contentOf(folder / "of_report.json"))["frames"];
    ASSERT_EQ(3u, frames.size());
    EXPECT_EQ(expected, frames[0]);
    EXPECT_EQ("still.png", frames[1]["file"]);
    EXPECT_EQ(false, frames[1]["moves"]);
    EXPECT_EQ("drive.mp4.000007", frames[2]["file"]);
    EXPECT_EQ(expected["viewmat_end"], frames[2]["viewmat_end"]);

    for (const std::string& damaged :
         {std::string("{}"), std::string("no JSON"), json({{"input", "x"}, {"status", "ok"}}).dump()})
    {
        writeContent(folder / "report.jsonl", street.dump() + "\n" + damaged + "\n");
        const Outcome refused =
            exportMotion({"--report=" + (folder / "report.jsonl"), camera, "--row_poses=" + (folder / "none.json")});
        EXPECT_EQ(1, refused.exitCode);
        EXPECT_NE(std::string::npos, refused.messages.find("report.jsonl, line 2")) << refused.messages;
        EXPECT_FALSE(cv::utils::fs::exists(folder / "none.json"));
    }
}

//! Compares a map of rsackermann_correct with one that has been exported, where the raw image is seen.
void expectSameMap(const std::string& maps, const std::string& exported)
{
    cv::Mat columns, rows;
    cv::FileStorage fs(maps, cv::FileStorage::READ);
    fs["map1"] >> columns;
    fs["map2"] >> rows;
    const cv::Mat map = cv::imread(exported, cv::IMREAD_UNCHANGED);
    ASSERT_EQ(columns.size(), map.size());
    for (int y = 0; y < map.rows; y++)
        for (int x = 0; x < map.cols; x++)
        {
            const cv::Point2d expected(columns.at<float>(y, x), rows.at<float>(y, x));
            if (expected.x >= 0 && expected.y >= 0 && expected.x <= 639 && expected.y <= 379)
            {
                ASSERT_LT(cv::norm(placeOf(map, x, y, map.size(), 1) - expected), 1e-3) << x << ", " << y;
            }
        }
}

// What is rebuilt from a line of a report makes the same map as rsackermann_correct has made.
TEST_F(Export, report_of_rsackermann_correct)
{
    const std::string camera = "--camera=" + streetFolder() + "/camera.yml";
    const Outcome corrected = correct({streetFolder() + "/rolling.png", camera, "--wall=2.5", "--roll=1",
                                       "--maps=" + (folder / "maps.yml"), "--report=" + (folder / "report.jsonl")});
    ASSERT_EQ(0, corrected.exitCode) << corrected.messages;
    ASSERT_EQ("ok", json::parse(contentOf(folder / "report.jsonl"))["status"]);
    const Outcome exported = exportMotion({"--report=" + (folder / "report.jsonl"), camera, "--roll=1",
                                           "--stmap=" + folder.path(), "--stmap_format=exr"});
    ASSERT_EQ(0, exported.exitCode) << exported.messages;
    expectSameMap(folder / "maps.yml", folder / "rolling.png.rectify.exr");
}

// A frame of a sequence has an inverse-depth offset, which the line of the report has, too.
TEST_F(Export, report_of_a_drive)
{
    const std::string camera = "--camera=" + streetFolder() + "/camera.yml", first = streetFolder() + "/rolling.png",
                      second = folder / "second.png";
    cv::Mat image = cv::imread(first), nearer;
    cv::warpAffine(image, nearer, cv::Matx23d(1.04, 0, -12.8, 0, 1.04, -7.6), image.size(), cv::INTER_CUBIC);
    cv::imwrite(second, nearer);
    const Outcome corrected =
        correct({first, second, camera, "--carry", "--maps=" + folder.path(), "--report=" + (folder / "report.jsonl")});
    ASSERT_EQ(0, corrected.exitCode) << corrected.messages;
    std::istringstream lines(contentOf(folder / "report.jsonl"));
    std::string line;
    std::getline(lines, line);
    std::getline(lines, line);
    json frame = json::parse(line);
    ASSERT_EQ("ok", frame["status"]);
    ASSERT_TRUE(frame.contains("relief"));
    const Arguments stmap = {"--report=" + (folder / "report.jsonl"), camera, "--stmap=" + folder.path(),
                             "--stmap_format=exr"};
    const Outcome exported = exportMotion(stmap);
    ASSERT_EQ(0, exported.exitCode) << exported.messages;
    expectSameMap(folder / "second.yml.gz", folder / "second.png.rectify.exr");

    const json good = frame["relief"];
    for (int i = 0; i < 5; i++)
    {
        json bad = good;
        if (i == 0)
            bad["columns"] = 3;
        else if (i == 1)
            bad["columns"] = bad["columns"].get<int>() + 1;
        else if (i == 2)
            bad["area"].erase(0);
        else if (i == 3)
            bad["values"][1] = "near";
        else
            bad["area"][2] = 0;
        frame["relief"] = bad;
        writeContent(folder / "report.jsonl", frame.dump() + "\n");
        const Outcome refused = exportMotion(stmap);
        EXPECT_NE(0, refused.exitCode) << i;
        const std::string named = i == 3 ? "report.jsonl, line 1" : i == 4 ? "offsetArea" : "relief";
        EXPECT_NE(std::string::npos, refused.messages.find(named)) << refused.messages;
    }
}

// With a gyro rows turn by a curve, which is in the maps of both programs.
TEST_F(Export, report_of_rows_that_shake)
{
    cv::imwrite(folder / "dark.png", cv::Mat(480, 640, CV_8U, cv::Scalar(0)));
    writeContent(folder / "log.csv", "file,time_s\ndark.png,1\n");
    std::string gyro = "time_s,yaw_rate_deg_s,pitch_rate_deg_s,roll_rate_deg_s\n";
    for (int i = 0; i < 400; i++)
        gyro += cv::format("%g,60,%.9g,10\n", 0.5 + i / 400., 8 * std::sin(2 * CV_PI * 5 * i / 400.));
    writeContent(folder / "gyro.csv", gyro);
    const Outcome corrected = correct({folder / "dark.png", "--focal=500", "--readout=0.03",
                                       "--gyro=" + (folder / "gyro.csv"), "--log=" + (folder / "log.csv"),
                                       "--maps=" + (folder / "maps.yml"), "--report=" + (folder / "report.jsonl")});
    ASSERT_EQ(0, corrected.exitCode) << corrected.messages;
    json frame = json::parse(contentOf(folder / "report.jsonl"));
    ASSERT_EQ("ok", frame["status"]);
    ASSERT_EQ(17u, frame["rotation_curve"].size());
    EXPECT_GT(std::abs(frame["rotation_curve"][0][0].get<double>()), 1e-4);
    EXPECT_LT(std::abs(frame["rotation_curve"][0][1].get<double>()), 1e-8); // the yaw is steady
    const Arguments stmap = {"--report=" + (folder / "report.jsonl"), "--stmap=" + folder.path(), "--stmap_format=exr"};
    const Outcome exported = exportMotion(stmap);
    ASSERT_EQ(0, exported.exitCode) << exported.messages;
    expectSameMap(folder / "maps.yml", folder / "dark.png.rectify.exr");

    for (const json& bad : {json({{0, 0}, {0, 0}}), json({{0, 0, 0}}), json("none"), json({{0, 0, 0}, {0, 0, 4}})})
    {
        frame["rotation_curve"] = bad;
        writeContent(folder / "report.jsonl", frame.dump() + "\n");
        const Outcome refused = exportMotion(stmap);
        EXPECT_NE(0, refused.exitCode) << bad;
        const std::string named = bad.is_string()                         ? "report.jsonl, line 1"
                                  : bad.size() == 1 || bad[0].size() == 3 ? "rotationCurve"
                                                                          : "rotation_curve";
        EXPECT_NE(std::string::npos, refused.messages.find(named)) << refused.messages;
    }
}

TEST_F(Export, frames_without_a_motion_stay_as_they_are)
{
    {
        cv::FileStorage fs(folder / "motion.yml", cv::FileStorage::WRITE);
        cv::rsackermann::AckermannMotion().write(fs);
    }
    write({"--row_poses=" + (folder / "poses.json"), "--mesh=" + (folder / "mesh.json")});
    const json frame = json::parse(contentOf(folder / "poses.json"))["frames"][0];
    EXPECT_EQ(false, frame["moves"]);
    EXPECT_EQ(0, cv::norm(poseOf(frame["viewmat_start"]) - Pose::eye()));
    EXPECT_EQ(0, cv::norm(poseOf(frame["viewmat_end"]) - Pose::eye()));
    const json nodes = json::parse(contentOf(folder / "mesh.json"))["frames"][0]["nodes"];
    EXPECT_FALSE(nodes.empty());
    for (const json& node : nodes)
        EXPECT_LT(cv::norm(cv::Point2d(node[0], node[1]) - cv::Point2d(node[2], node[3])), 1e-9);
}

// Whatever the options and the log say: the report and the same options for the camera give the maps.
TEST_F(Export, report_and_camera_give_the_maps)
{
    writeContent(folder / "log.csv",
                 "file,roll_deg,pitch_deg,speed_kmh,gravity_sigma_deg\nrolling.png,1.5,-4,50,0.2\n");
    writeContent(folder / "roll.csv", "frame,roll_deg\n0,-2\n");
    writeContent(folder / "pitch.csv", "frame,pitch_deg,yaw_rate_deg_s\n0,3,35\n");
    const std::string camera = "--camera=" + streetFolder() + "/camera.yml", image = streetFolder() + "/rolling.png";
    const std::vector<Arguments> cameras = {{camera},
                                            {camera, "--roll=1", "--pitch=2"},
                                            {camera, "--reference=first", "--heading=3", "--height=1.5"},
                                            {"--focal=816", "--readout=0.0133", "--pitch=-1"},
                                            {"--focal=816", "--scan=bottom_to_top"},
                                            {camera, "--scan=left_to_right"}};
    const std::vector<Arguments> facts = {{}, {"log.csv"}, {"roll.csv"}, {"pitch.csv"}};
    for (const Arguments& ofCamera : cameras)
        for (const Arguments& log : facts)
        {
            Arguments arguments = ofCamera, exported = ofCamera;
            arguments.insert(arguments.end(), {image, "--overwrite", "--maps=" + (folder / "maps.yml.gz"),
                                               "--report=" + (folder / "report.jsonl")});
            if (!log.empty())
                arguments.push_back("--log=" + (folder / log[0]));
            exported.insert(exported.end(), {"--report=" + (folder / "report.jsonl"), "--stmap=" + (folder / "stmap"),
                                             "--stmap_format=exr"});
            SCOPED_TRACE(ofCamera.back() + (log.empty() ? "" : " " + log[0]));
            ASSERT_EQ(0, correct(arguments).exitCode);
            const Outcome outcome = exportMotion(exported);
            ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
            expectSameMap(folder / "maps.yml.gz", folder / "stmap/rolling.png.rectify.exr");
        }
    const Outcome other = exportMotion(
        {"--report=" + (folder / "report.jsonl"), "--focal=816", "--size=641x380", "--mesh=" + (folder / "mesh.json")});
    EXPECT_EQ(1, other.exitCode);
    EXPECT_NE(std::string::npos, other.messages.find("has 640 x 380 pixels")) << other.messages;
}

// Frames of a sequence, with the heading that they show.
TEST_F(Export, found_headings_are_those_of_the_maps)
{
    ASSERT_EQ(0, simulate({"--output=" + (folder / "drive"), "--frames=3", "--speed=40", "--heading=3"}).exitCode);
    ASSERT_EQ(0, correct({"--focal=816", "--readout=0.025", "--roll=0", "--pitch=0", folder / "drive/frames", "--carry",
                          "--output=" + (folder / "out/"), "--maps=" + (folder / "maps/"),
                          "--report=" + (folder / "report.jsonl")})
                     .exitCode);
    const std::string report = contentOf(folder / "report.jsonl");
    const json last = json::parse(report.substr(report.rfind('\n', report.size() - 2) + 1));
    EXPECT_GT(last["heading_correction_deg"].get<double>(), 1);
    ASSERT_EQ(0, exportMotion(
                     {"--report=" + (folder / "report.jsonl"), "--stmap=" + (folder / "stmap"), "--stmap_format=exr"})
                     .exitCode);
    expectSameMap(folder / "maps/000002.yml.gz", folder / "stmap/000002.png.rectify.exr");
}

// Options and columns of a log at random: the report alone gives the maps.
void checkRandomCommandLines(const TemporaryFolder& folder, uint64 seed, int rounds)
{
    ASSERT_EQ(0, simulate({"--output=" + (folder / "drive"), "--frames=3", "--speed=40", "--left=6", "--right=8",
                           "--lens=-0.2,0.05,0.001,0.001"})
                     .exitCode);
    const std::string image = folder / "drive/frames/000002.png";
    cv::RNG rng(seed);
    const auto number = [&rng](const char* format, double low, double high) {
        return cv::format(format, rng.uniform(low, high));
    };
    int moving = 0;
    for (int round = 0; round < rounds; round++)
    {
        const bool isSequence = round % 4 == 3;
        Arguments arguments;
        if (rng.uniform(0, 2))
            arguments.push_back("--camera=" + (folder / "drive/camera.yml"));
        else
            arguments = {number("--focal=%.3f", 700, 900), number("--readout=%.4f", 0.01, 0.03)};
        const std::string options[] = {number("--focal_sigma=%.3f", 1, 50),
                                       rng.uniform(0, 2) ? "--reference=first" : number("--reference=%.2f", 0, 379),
                                       number("--roll=%.3f", -2, 2),
                                       number("--pitch=%.3f", -4, 4),
                                       number("--heading=%.3f", -5, 5),
                                       number("--height=%.3f", 1, 2),
                                       number("--wall=%.3f", 2, 9),
                                       number("--speed=%.3f", 20, 60),
                                       number("--yaw_rate=%.3f", -20, 20),
                                       number("--gravity_sigma=%.3f", 0, 1),
                                       isSequence ? "--smooth" : "--scan=bottom_to_top"};
        for (const std::string& option : options)
            if (rng.uniform(0, 3) == 0)
                arguments.push_back(option);
        const std::pair<std::string, std::string> columns[] = {{"time_s", ""},
                                                               {"speed_kmh", number("%.3f", 20, 60)},
                                                               {"yaw_rate_deg_s", number("%.3f", -20, 20)},
                                                               {"roll_deg", number("%.3f", -2, 2)},
                                                               {"pitch_deg", number("%.3f", -4, 4)},
                                                               {"gravity_sigma_deg", number("%.3f", 0.01, 1)}};
        std::string log[4] = {"frame", "0", "1", "2"};
        for (const std::pair<std::string, std::string>& column : columns)
            if (rng.uniform(0, 2))
                for (int row = 0; row < 4; row++)
                    log[row] += "," + (row == 0                ? column.first
                                       : column.second.empty() ? cv::format("%g", 7 + row / 30.)
                                                               : column.second);
        writeContent(folder / "log.csv", log[0] + "\n" + log[1] + "\n" + log[2] + "\n" + log[3] + "\n");
        if (rng.uniform(0, 3))
            arguments.push_back("--log=" + (folder / "log.csv"));
        if (isSequence)
            arguments.push_back("--carry");
        arguments.push_back(isSequence ? folder / "drive/frames" : image);
        std::string trace;
        for (const std::string& argument : arguments)
            trace += argument + " ";
        SCOPED_TRACE(trace + log[0]);
        const Outcome corrected = correct(arguments + Arguments{"--overwrite", "--maps=" + (folder / "maps/"),
                                                                "--report=" + (folder / "report.jsonl")});
        if (corrected.exitCode == 2) // --carry beside --smooth, say
            continue;
        ASSERT_EQ(0, corrected.exitCode) << corrected.messages;
        const Outcome exported = exportMotion(
            {"--report=" + (folder / "report.jsonl"), "--stmap=" + (folder / "stmap"), "--stmap_format=exr"});
        ASSERT_EQ(0, exported.exitCode) << exported.messages;
        std::istringstream lines(contentOf(folder / "report.jsonl"));
        for (std::string line; std::getline(lines, line);)
        {
            moving += json::parse(line)["status"] == "ok";
            const std::string input = json::parse(line)["input"];
            const std::string stem = input.substr(input.size() - 10, 6);
            expectSameMap(folder / ("maps/" + stem + ".yml.gz"), folder / ("stmap/" + stem + ".png.rectify.exr"));
        }
    }
    EXPECT_GE(moving, rounds / 2);
}

TEST_F(Export, report_alone_gives_the_maps_of_random_command_lines)
{
    checkRandomCommandLines(folder, 11, 5);
}

TEST_F(Export, report_alone_gives_the_maps_of_many_random_command_lines)
{
    applyTestTag(CV_TEST_TAG_LONG);
    checkRandomCommandLines(folder, 12, 100);
}

// A camera of which the report says something else isn't used in silence.
TEST_F(Export, options_that_contradict_the_report)
{
    ASSERT_EQ(0, correct({streetFolder() + "/rolling.png", "--focal=816", "--readout=0.0133", "--wall=2.5",
                          "--report=" + (folder / "report.jsonl")})
                     .exitCode);
    const Arguments report = {"--report=" + (folder / "report.jsonl"), "--row_poses=" + (folder / "poses.json")},
                    same = {"--focal=816", "--readout=0.0133"};
    EXPECT_EQ(0, exportMotion(report).exitCode);
    std::string poses = contentOf(folder / "poses.json");
    for (const Arguments& agreeing :
         {same, Arguments{"--readout=0.0133"}, Arguments{"--size=640x380"}, Arguments{"--roll=0", "--pitch=0"},
          Arguments{"--scan=top_to_bottom", "--reference=middle", "--heading=0"}})
    {
        std::remove((folder / "poses.json").c_str());
        EXPECT_EQ(0, exportMotion(report + agreeing).exitCode) << agreeing[0];
        EXPECT_EQ(poses, contentOf(folder / "poses.json")) << agreeing[0];
    }
    std::remove((folder / "poses.json").c_str());
    const std::pair<Arguments, const char*> others[] = {{{"--focal=700", "--readout=0.0133"}, "matrix"},
                                                        {{"--focal=816", "--readout=0.02"}, "line_delay_s"},
                                                        {same + Arguments{"--scan=bottom_to_top"}, "scan"},
                                                        {same + Arguments{"--reference=first"}, "reference_line"},
                                                        {same + Arguments{"--heading=1"}, "heading_deg"},
                                                        {same + Arguments{"--height=1"}, "height_m"},
                                                        {{"--readout=0.02"}, "line_delay_s"},
                                                        {{"--line_delay=3e-5"}, "line_delay_s"},
                                                        {{"--scan=bottom_to_top"}, "scan"},
                                                        {{"--reference=first"}, "reference_line"},
                                                        {{"--heading=1"}, "heading_deg"},
                                                        {{"--height=1"}, "height_m"}};
    for (const std::pair<Arguments, const char*>& other : others)
    {
        const Outcome outcome = exportMotion(report + other.first);
        EXPECT_EQ(1, outcome.exitCode) << other.second;
        EXPECT_NE(std::string::npos, outcome.messages.find(std::string("another ") + other.second)) << outcome.messages;
        EXPECT_FALSE(cv::utils::fs::exists(folder / "poses.json"));
    }
}

// They may be those beside a log whose mount counted.
TEST_F(Export, tilts_are_those_of_the_report)
{
    ASSERT_EQ(0, correct({streetFolder() + "/rolling.png", "--focal=816", "--readout=0.0133", "--wall=2.5", "--roll=1",
                          "--report=" + (folder / "report.jsonl")})
                     .exitCode);
    const Arguments arguments = {"--report=" + (folder / "report.jsonl"), "--row_poses=" + (folder / "poses.json")};
    ASSERT_EQ(0, exportMotion(arguments).exitCode);
    const std::string poses = contentOf(folder / "poses.json");
    for (const char* tilt : {"--roll=1", "--pitch=0", "--roll=2", "--pitch=-3"})
    {
        std::remove((folder / "poses.json").c_str());
        const Outcome outcome = exportMotion(arguments + Arguments{tilt});
        EXPECT_EQ(0, outcome.exitCode) << tilt;
        EXPECT_EQ(poses, contentOf(folder / "poses.json")) << tilt;
        const bool isOther = std::string(tilt) == "--roll=2" || std::string(tilt) == "--pitch=-3";
        EXPECT_EQ(isOther, outcome.messages.find("which counts") != std::string::npos) << outcome.messages;
    }
}

// The depth isn't in the report, and maps without it would be those of the planes.
TEST_F(Export, maps_that_follow_a_depth_are_refused)
{
    cv::Mat depth = cv::Mat::zeros(380, 640, CV_16U);
    depth(cv::Rect(310, 320, 20, 40)) = 4000; // of the road, where no vertical is
    cv::imwrite(folder / "rolling.png", depth);
    ASSERT_EQ(0, correct({streetFolder() + "/rolling.png", "--camera=" + streetFolder() + "/camera.yml", "--wall=2.5",
                          "--depth=" + (folder / "rolling.png"), "--report=" + (folder / "report.jsonl")})
                     .exitCode);
    const std::string report = "--report=" + (folder / "report.jsonl");
    for (const char* result : {"--stmap=", "--mesh="})
    {
        const Outcome outcome = exportMotion({report, result + (folder / "result")});
        EXPECT_EQ(1, outcome.exitCode);
        EXPECT_NE(std::string::npos, outcome.messages.find("corrected with a depth")) << outcome.messages;
        EXPECT_FALSE(cv::utils::fs::exists(folder / "result"));
    }
    EXPECT_EQ(0, exportMotion({report, "--row_poses=" + (folder / "poses.json")}).exitCode);
}

// A car in reverse, and a shutter along the columns.
TEST_F(Export, direction_and_lines_are_those_of_the_report)
{
    const std::string line =
        "{\"input\":\"a.png\",\"status\":\"ok\",\"alpha\":0.001,\"beta\":-0.01,\"wall_offset\":0,\"wall_ratio\":1,"
        "\"road_slope\":-0.02,\"direction\":-1,\"roll_correction_deg\":0,\"pitch_correction_deg\":0,"
        "\"wall_distance_m\":null,\"scale\":\"unknown\"}\n";
    writeContent(folder / "report.jsonl", line);
    const std::string report = "--report=" + (folder / "report.jsonl"), size = "--size=64x48";
    const Outcome poses =
        exportMotion({report, size, "--scan=left_to_right", "--row_poses=" + (folder / "poses.json")});
    ASSERT_EQ(0, poses.exitCode) << poses.messages;
    EXPECT_EQ(63, json::parse(contentOf(folder / "poses.json"))["end_line"]);

    cv::rsackermann::AckermannMotion motion;
    motion.status = cv::rsackermann::MOTION_OK;
    motion.alpha = 0.001;
    motion.wallSlope = -0.01;
    motion.wallRatio = 1;
    motion.roadSlope = -0.02;
    motion.direction = -1;
    cv::Mat columns, rows;
    cv::rsackermann::WarpMapGenerator::create(cv::rsackermann::RollingShutterCamera::fromFocal(cv::Size(64, 48), 50))
        ->initRectifyMap(motion, columns, rows);
    const Outcome maps = exportMotion({report, size, "--focal=50", "--stmap=" + (folder / "s"), "--stmap_format=exr"});
    ASSERT_EQ(0, maps.exitCode) << maps.messages;
    const cv::Mat map = cv::imread(folder / "s/a.png.rectify.exr", cv::IMREAD_UNCHANGED);
    for (int y = 0; y < 48; y += 5)
        for (int x = 0; x < 64; x += 5)
            EXPECT_LT(cv::norm(placeOf(map, x, y, map.size(), 1) -
                               cv::Point2d(columns.at<float>(y, x), rows.at<float>(y, x))),
                      1e-3);
}

TEST_F(Export, images_of_one_pixel_across)
{
    for (const char* size : {"1x1", "1x9", "9x1", "2x2"})
    {
        const Outcome outcome = exportMotion({"--motion=" + (folder / "motion.yml"), std::string("--size=") + size,
                                              "--focal=5", "--mesh=" + (folder / "mesh.json")});
        EXPECT_EQ(0, outcome.exitCode) << size << outcome.messages;
        EXPECT_EQ(17 * 10, int(json::parse(contentOf(folder / "mesh.json"))["frames"][0]["nodes"].size()));
    }
}

// A drive of which the rates are known, and the log of it that the program's own reader has read.
class ExportGyroLog : public Export
{
public:
    // Rates in deg/s.
    json frame(const std::string& input, double time, double yaw, double pitch, double roll) const
    {
        const double unit = 500 * 0.03 / 480 * CV_PI / 180; // seconds of a row time, radians of a degree
        return {{"input", input},
                {"time_s", time},
                {"width", 640},
                {"height", 480},
                {"status", "ok"},
                {"alpha", yaw * unit / 2},
                {"beta", 0},
                {"wall_offset", 0},
                {"wall_ratio", 0},
                {"road_slope", 0},
                {"direction", 1},
                {"pitch_rate", pitch * unit},
                {"roll_rate", roll * unit},
                {"roll_correction_deg", 0},
                {"pitch_correction_deg", 0},
                {"wall_distance_m", 0},
                {"scale", "unknown"}};
    }

    Outcome run(const std::vector<json>& lines, const Arguments& options = {"--readout=0.03"}) const
    {
        std::string report;
        for (const json& line : lines)
            report += line.dump() + "\n";
        writeContent(folder / "report.jsonl", report);
        Arguments all = {"--report=" + (folder / "report.jsonl"), "--focal=500", "--gcsv=" + (folder / "drive.gcsv")};
        all.insert(all.end(), options.begin(), options.end());
        return exportMotion(all);
    }

    cv::Mat rates() const { return rsackermann_samples::readGyro(folder / "drive.gcsv", "test").rates; }
};

TEST_F(ExportGyroLog, is_read_as_the_rates_of_the_report)
{
    json still = frame("4.png", 1.3, 0, 0, 0);
    still["status"] = "not_significant";
    const json first = frame("3.png", 0.9, 1, 2, 3); // of a frame that is there twice the last line counts
    const Outcome outcome = run({frame("1.png", 1, 30, 0, 0), first, frame("3.png", 1 + 1 / 15., -12, 3, -4.5),
                                 frame("2.png", 1 + 1 / 30., 7, -20, 10), still});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    const rsackermann_samples::GyroRecording log = rsackermann_samples::readGyro(folder / "drive.gcsv", "test");
    const double times[] = {1, 1 + 1 / 30., 1 + 1 / 15., 1.3},
                 expected[][3] = {{0, 30, 0}, {20, 7, 10}, {-3, -12, -4.5}, {0, 0, 0}}; // about right, down, ahead
    ASSERT_EQ(4, log.times.rows);
    for (int i = 0; i < 4; i++)
    {
        EXPECT_NEAR(times[i], log.times.at<double>(i), 1e-9);
        for (int k = 0; k < 3; k++)
            EXPECT_NEAR(expected[i][k], log.rates.at<double>(i, k) * 180 / CV_PI, 1e-6) << i << ", " << k;
    }
}

// A camera that leans and looks down turns about its own axes, of which none is the vertical.
TEST_F(ExportGyroLog, yaw_is_about_the_vertical)
{
    ASSERT_EQ(0, run({frame("1.png", 1, 30, 0, 0), frame("2.png", 2, 30, 0, 0)},
                     {"--readout=0.03", "--roll=10", "--pitch=20"})
                     .exitCode);
    const double roll = 10 * CV_PI / 180, pitch = 20 * CV_PI / 180, rate = 30 * CV_PI / 180;
    const cv::Matx13d down(std::sin(roll), std::cos(roll) * std::cos(pitch), std::sin(pitch));
    const cv::Mat found = rates();
    EXPECT_LT(cv::norm(found.row(1), cv::Mat(down * (rate / cv::norm(down)))), 1e-7) << found;
}

// The rates come back out of rsackermann_correct, which has nothing but the log.
TEST_F(ExportGyroLog, turns_images_again)
{
    std::vector<json> lines;
    for (int i = 0; i < 40; i++)
        lines.push_back(frame(cv::format("%02d.png", i), 0.5 + i / 30., 30, -20, 10));
    ASSERT_EQ(0, run(lines).exitCode);
    cv::imwrite(folder / "dark.png", cv::Mat(480, 640, CV_8U, cv::Scalar(0)));
    writeContent(folder / "log.csv", "file,time_s\ndark.png,1\n");
    const Outcome outcome = correct({folder / "dark.png", "--focal=500", "--readout=0.03", "--report=-",
                                     "--gyro=" + (folder / "drive.gcsv"), "--log=" + (folder / "log.csv")});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    const json line = json::parse(outcome.output);
    EXPECT_NEAR(30, line["yaw_rate_deg_s"].get<double>(), 1e-3);
    EXPECT_NEAR(-20, line["pitch_rate_deg_s"].get<double>(), 1e-3);
    EXPECT_NEAR(10, line["roll_rate_deg_s"].get<double>(), 1e-3);
}

TEST_F(ExportGyroLog, what_has_no_log_is_refused)
{
    const json first = frame("1.png", 1, 30, 0, 0);
    json timeless = frame("2.png", 2, 30, 0, 0), video = first, other = frame("b.mp4", 2, 30, 0, 0);
    timeless.erase("time_s");
    video["input"] = "a.mp4";
    video["frame"] = other["frame"] = 1;
    const auto expectRefused = [&](const std::vector<json>& lines, const std::string& part) {
        const Outcome outcome = run(lines);
        EXPECT_EQ(1, outcome.exitCode);
        EXPECT_NE(std::string::npos, outcome.messages.find(part)) << outcome.messages;
        EXPECT_FALSE(cv::utils::fs::exists(folder / "drive.gcsv"));
    };
    expectRefused({first, timeless}, "the time of 2.png isn't known");
    expectRefused({first, frame("2.png", 1, 3, 0, 0)}, "1.png and 2.png have the same time, 1 s");
    expectRefused({first, first}, "fewer than two frames");
    expectRefused({video, other}, "a.mp4 and b.mp4 have clocks of their own");
    expectRefused({first, video}, "1.png and a.mp4 have clocks of their own");
    const Outcome outcome = run({first, frame("2.png", 2, 3, 0, 0)}, {});
    EXPECT_EQ(2, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("--gcsv needs the line delay")) << outcome.messages;
}

// A profile's size needn't be that of the images.
TEST_F(Export, lens_profile_is_scaled_to_the_report)
{
    writeContent(folder / "lens.json",
                 "{\"calib_dimension\": {\"w\": 1280, \"h\": 760}, \"fisheye_params\": {\"camera_matrix\": "
                 "[[1632, 0, 640], [0, 1632, 380], [0, 0, 1]], \"distortion_coeffs\": [0, 0, 0, 0]}}");
    const std::string camera = "--camera=" + (folder / "lens.json");
    ASSERT_EQ(0, correct({streetFolder() + "/rolling.png", camera, "--report=" + (folder / "r.jsonl")}).exitCode);
    const Outcome outcome =
        exportMotion({"--report=" + (folder / "r.jsonl"), camera, "--row_poses=" + (folder / "poses.json")});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    EXPECT_EQ(640, json::parse(contentOf(folder / "poses.json"))["width"]);
}

// Of each kind: refused before anything is written.
TEST_F(Export, results_that_exist)
{
    writeContent(folder / "points.csv", "file,x,y\nrolling.png,1,2\n");
    writeContent(folder / "cloud.csv", "file,x,y,z\nrolling.png,1,2,9\n");
    writeContent(folder / "times.csv", "file,time_s\nrolling.png,7\nglobal.png,8\n");
    const std::string report = "--report=" + (folder / "report.jsonl");
    ASSERT_EQ(0, correct({streetFolder() + "/rolling.png", streetFolder() + "/global.png", "--wall=2.5", report,
                          "--camera=" + streetFolder() + "/camera.yml", "--log=" + (folder / "times.csv")})
                     .exitCode);
    const std::pair<Arguments, const char*> cases[] = {
        {{"--row_poses=" + (folder / "poses.json")}, "poses.json"},
        {{"--gcsv=" + (folder / "gyro.gcsv")}, "gyro.gcsv"},
        {{"--mesh=" + (folder / "mesh.json")}, "mesh.json"},
        {{"--tracks=" + (folder / "points.csv"), "--tracks_output=" + (folder / "tracks.csv")}, "tracks.csv"},
        {{"--points=" + (folder / "cloud.csv"), "--points_output=" + (folder / "places.csv")}, "places.csv"},
        {{"--colmap=" + (folder / "colmap")}, "colmap/cameras.txt"},
        {{"--colmap=" + (folder / "colmap2")}, "colmap2/masks/rolling.png.png"},
        {{"--stmap=" + (folder / "stmap")}, "stmap/rolling.png.distort.png"}};
    for (const auto& c : cases)
    {
        const std::string result = folder / c.second;
        cv::utils::fs::createDirectories(result.substr(0, result.rfind('/')));
        writeContent(result, "precious");
        // Beside another result, which isn't there yet.
        const Arguments other = {&c == cases ? "--mesh=" + (folder / "other.json")
                                             : "--row_poses=" + (folder / "other.json")};
        const Outcome refused = runProgram(EXPORT_PROGRAM, Arguments{report} + c.first + other);
        EXPECT_EQ(1, refused.exitCode) << c.second;
        EXPECT_NE(std::string::npos, refused.messages.find(result + " exists (--overwrite")) << refused.messages;
        EXPECT_EQ("precious", contentOf(result));
        EXPECT_FALSE(cv::utils::fs::exists(folder / "other.json")) << c.second;
        const Outcome replaced = exportMotion(Arguments{report} + c.first);
        EXPECT_EQ(0, replaced.exitCode) << replaced.messages;
        EXPECT_NE("precious", contentOf(result));
    }
}

// Of each kind that reads, and whatever is in the way: no other result is there either.
TEST_F(Export, no_result_beside_an_error)
{
    writeContent(folder / "points.csv", "file,x,y\nrolling.png,1,near\n");
    writeContent(folder / "cloud.csv", "file,x,y,z\nother.png,1,2,9\n");
    writeContent(folder / "none.csv", "");
    writeContent(folder / "in_the_way", "");
    const json good = lineOfReport(truth, "street/rolling.png");
    const auto with = [&](const char* key, const json& value) {
        json line = good;
        line[key] = value;
        return line;
    };
    const std::string out = folder / "out/";
    const struct
    {
        json second; // line of the report
        Arguments options;
        const char* reason;
    } cases[] = {
        {good,
         {"--tracks=" + (folder / "points.csv"), "--tracks_output=" + out + "tracks.csv"},
         "points.csv, column y"},
        {good, {"--tracks=" + (folder / "none.csv"), "--tracks_output=" + out + "tracks.csv"}, "none.csv"},
        {good, {"--points=" + (folder / "cloud.csv"), "--points_output=" + out + "u.csv"}, "cloud.csv, column file"},
        {good, {"--gcsv=" + out + "gyro.gcsv"}, "the time of"},
        {good, {"--stmap=" + (folder / "in_the_way")}, "in_the_way is no folder"},
        {good, {"--mesh=" + (folder / "in_the_way/mesh.json")}, "in_the_way is no folder"},
        {with("alpha", 1e200), {}, "second.png: motion.alpha is 1e+200"},
        {with("relief", {{"columns", 4}, {"values", std::vector<double>(16)}, {"area", {0, 0, 0, 1}}}),
         {},
         "second.png: motion.offsetArea"},
        {with("rotation_curve", {{0, 0, 0}}), {}, "second.png: motion.rotationCurve"}};
    for (const auto& c : cases)
    {
        SCOPED_TRACE(c.reason);
        json second = c.second;
        second["input"] = "street/second.png";
        writeContent(folder / "report.jsonl", good.dump() + "\n" + second.dump() + "\n");
        Arguments arguments = {"--report=" + (folder / "report.jsonl"), "--camera=" + streetFolder() + "/camera.yml",
                               "--colmap=" + out + "colmap", "--row_poses=" + out + "poses.json"};
        for (const char* option : {"--mesh=", "--stmap="})
            if (c.options.empty() || c.options[0].find(option) != 0)
                arguments.push_back(option + out + "more");
        const Outcome outcome = exportMotion(arguments + c.options);
        EXPECT_NE(0, outcome.exitCode);
        EXPECT_NE(std::string::npos, outcome.messages.find(c.reason)) << outcome.messages;
        EXPECT_FALSE(cv::utils::fs::exists(out));
    }
}

TEST_F(Export, usage)
{
    const std::string motion = "--motion=" + (folder / "motion.yml"),
                      camera = "--camera=" + streetFolder() + "/camera.yml";
    EXPECT_EQ(2, exportMotion({camera}).exitCode);
    EXPECT_EQ(2, exportMotion({motion, camera, "--report=x"}).exitCode);
    EXPECT_EQ(2, exportMotion({motion}).exitCode); // the size isn't known
    EXPECT_EQ(2, exportMotion({motion, camera, "--tracks=x"}).exitCode);
    EXPECT_EQ(2, exportMotion({motion, camera, "--points=x"}).exitCode);
    EXPECT_EQ(2, exportMotion({motion, camera, "--stmap=x", "--stmap_format=jpg"}).exitCode);
    EXPECT_EQ(2, exportMotion({motion, camera, "--mesh=x", "--mesh_size=1x5"}).exitCode);
    EXPECT_EQ(2, exportMotion({motion, camera, "--mesh=x", "--mesh_size=10000x10000"}).exitCode);
    for (const char* useless : {"--mesh_size=5x5", "--stmap_format=exr"})
    {
        const Outcome outcome = exportMotion({motion, camera, useless, "--row_poses=x"});
        EXPECT_EQ(2, outcome.exitCode);
        EXPECT_NE(std::string::npos, outcome.messages.find("needs --")) << outcome.messages;
    }
    EXPECT_EQ(1, exportMotion({"--motion=" + (folder / "missing.yml"), camera}).exitCode);
    writeContent(folder / "empty.yml", "%YAML:1.0\n---\nx: 1\n");
    EXPECT_EQ(1, exportMotion({"--motion=" + (folder / "empty.yml"), camera}).exitCode);
    writeContent(folder / "damaged.yml", "%YAML:1.0\n---\nstatus: 0\nrms: 0\ncovariance: [ 1, 2 ]\n");
    const Outcome damaged = exportMotion({"--motion=" + (folder / "damaged.yml"), camera});
    EXPECT_EQ(1, damaged.exitCode);
    EXPECT_NE(std::string::npos, damaged.messages.find("damaged.yml holds no motion")) << damaged.messages;
    const std::string whole = contentOf(folder / "motion.yml");
    writeContent(folder / "half.yml", whole.substr(0, whole.rfind('\n', whole.find(" rms:")) + 1));
    const Outcome half = exportMotion({"--motion=" + (folder / "half.yml"), camera});
    EXPECT_EQ(1, half.exitCode);
    EXPECT_NE(std::string::npos, half.messages.find("half.yml holds no motion, or a part of one: it lacks rms"))
        << half.messages;
    writeContent(folder / "twice.yml", "%YAML:1.2\n   data: [ 570., 0., 3., 1. ]\nstatus: !!opencv-matrix\n");
    EXPECT_EQ(1, exportMotion({"--motion=" + (folder / "twice.yml"), camera}).exitCode);
    EXPECT_EQ(0, exportMotion({motion, "--size=640x380", "--focal=500", "--mesh=" + (folder / "m.json")}).exitCode);
    const Outcome nothing = exportMotion({motion, camera});
    EXPECT_EQ(2, nothing.exitCode);
    EXPECT_NE(std::string::npos, nothing.messages.find("nothing to do")) << nothing.messages;
}

TEST_F(Export, reports_without_a_motion)
{
    const std::string report = folder / "none.jsonl", poses = folder / "poses.json";
    const std::pair<const char*, const char*> reports[] = {
        {"", "none.jsonl has no lines"},
        {"\n \n", "none.jsonl has no lines"},
        {"{\"input\":\"a.png\",\"status\":\"failed\"}\n", "none.jsonl has no lines but of inputs that failed"}};
    for (const auto& c : reports)
        for (const Arguments& size : {Arguments(), Arguments{"--size=640x380"}})
        {
            writeContent(report, c.first);
            const Outcome outcome = exportMotion(size + Arguments{"--report=" + report, "--row_poses=" + poses});
            EXPECT_EQ(1, outcome.exitCode) << c.first;
            EXPECT_NE(std::string::npos, outcome.messages.find(c.second)) << outcome.messages;
            EXPECT_FALSE(cv::utils::fs::exists(poses));
        }
}

TEST_F(Export, no_result_replaces_an_input_or_another_result)
{
    const std::string camera = "--camera=" + streetFolder() + "/camera.yml", tracks = folder / "t.csv",
                      report = folder / "r.jsonl", raw = folder / "1.png";
    writeContent(tracks, "file,x,y\n");
    writeContent(raw, "raw");
    std::string lines;
    for (const std::string& input : {std::string("a/1.jpg"), std::string("b/1.jpg"), raw})
        lines += "{\"input\": \"" + input + "\", \"status\": \"not_significant\"}\n";
    writeContent(report, lines);
    const Arguments conflicts[] = {{"--mesh=" + report},
                                   {"--tracks=" + tracks, "--tracks_output=" + folder.path() + "/./t.csv"},
                                   {"--mesh=" + (folder / "a.json"), "--row_poses=" + (folder / "a.json")},
                                   {"--gcsv=" + report},
                                   {"--row_poses=" + raw},
                                   {"--colmap=" + (folder / "colmap")},
                                   {"--stmap=" + (folder / "stmap")}};
    for (const Arguments& conflict : conflicts)
    {
        Arguments arguments = {"--report=" + report, camera, "--size=640x380"};
        arguments.insert(arguments.end(), conflict.begin(), conflict.end());
        const Outcome outcome = exportMotion(arguments);
        EXPECT_EQ(2, outcome.exitCode) << conflict[0] << outcome.messages;
        EXPECT_EQ(lines, contentOf(report));
        EXPECT_EQ("file,x,y\n", contentOf(tracks));
        EXPECT_EQ("raw", contentOf(raw));
    }
    // The same frame twice is no conflict.
    writeContent(report, lines.substr(0, lines.find('\n') + 1) + lines.substr(0, lines.find('\n') + 1));
    const Outcome twice = exportMotion({"--report=" + report, camera, "--size=640x380", "--stmap=" + (folder / "s")});
    EXPECT_EQ(0, twice.exitCode) << twice.messages;
}

// Two inputs of one name, one of which moves.
TEST_F(Export, inputs_that_share_a_name_are_told_apart_by_their_folders)
{
    const std::string report = folder / "r.jsonl", tracks = folder / "t.csv", out = folder / "out.csv";
    const Arguments common = {"--report=" + report, "--camera=" + streetFolder() + "/camera.yml"};
    const std::string still = "{\"input\": \"b/1.jpg\", \"status\": \"not_significant\"}\n";
    Arguments street = {streetFolder() + "/rolling.png", common[1], "--report=" + report, "--wall=2.5"};
    ASSERT_EQ(0, correct(street).exitCode);
    json moving = json::parse(contentOf(report));
    ASSERT_EQ("ok", moving["status"]);
    moving["input"] = "a/1.jpg";
    writeContent(report, moving.dump() + "\n" + still);
    const auto run = [&](const Arguments& more) {
        Arguments all = common;
        all.insert(all.end(), more.begin(), more.end());
        return exportMotion(all);
    };
    const Arguments options = {"--tracks=" + tracks, "--tracks_output=" + out};

    writeContent(tracks, "file,x,y\n1.jpg,100,80\n");
    const Outcome ambiguous = run(options);
    EXPECT_EQ(1, ambiguous.exitCode);
    for (const char* part : {"line 2", "a/1.jpg", "b/1.jpg"})
        EXPECT_NE(std::string::npos, ambiguous.messages.find(part)) << ambiguous.messages;
    EXPECT_FALSE(cv::utils::fs::exists(out));

    writeContent(tracks, "file,x,y\na/1.jpg,100,80\nb/1.jpg,100,80\n");
    const Outcome byPath = run(options);
    ASSERT_EQ(0, byPath.exitCode) << byPath.messages;
    const std::vector<std::string> lines = linesOf(out);
    ASSERT_EQ(3u, lines.size());
    double x = 0, y = 0;
    ASSERT_EQ(2, std::sscanf(lines[1].c_str(), "a/1.jpg,%lf,%lf", &x, &y)) << lines[1];
    EXPECT_GT(std::abs(x - 100) + std::abs(y - 80), 0.5);
    EXPECT_EQ("b/1.jpg,100.000000,80.000000", lines[2]);

    for (const char* option : {"--mesh=", "--row_poses="})
    {
        ASSERT_EQ(0, run({option + (folder / "table.json")}).exitCode);
        const json frames = json::parse(contentOf(folder / "table.json"))["frames"];
        ASSERT_EQ(2u, frames.size());
        EXPECT_EQ("a/1.jpg", frames[0]["file"]) << option;
        EXPECT_EQ("b/1.jpg", frames[1]["file"]) << option;
    }
}

}} // namespace
