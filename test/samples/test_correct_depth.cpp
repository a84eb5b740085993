// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"
#include "rendered_drive.hpp"
#include "street_model.hpp"
#include "truth_file.hpp"

#include "opencv2/imgproc.hpp"

using namespace cv::rsackermann;

namespace opencv_test { namespace {

// A street with cars and trees, and its true depth in 1/256 m.
class CorrectDepth : public testing::Test
{
protected:
    static void SetUpTestCase()
    {
        folder_ = new TemporaryFolder;
        ASSERT_EQ(0, simulate({"--output=" + (*folder_ / "street"), "--depth", "--left=3.2", "--right=4",
                               "--obstacles=15", "--stagger=1.5"})
                         .exitCode);
    }

    static void TearDownTestCase() { delete folder_; }

    static std::string street(const std::string& name) { return *folder_ / ("street/" + name); }
    static cv::Mat1f metres(const std::string& name)
    {
        cv::Mat1f depth;
        cv::imread(street(name), cv::IMREAD_UNCHANGED).convertTo(depth, CV_32F, 1. / 256);
        return depth;
    }

    Outcome run(const Arguments& added) const
    {
        Arguments all = {street("rolling.png"),
                         "--camera=" + street("camera.yml"),
                         "--wall=3.2",
                         "--speed=60",
                         "--speed_sigma=0.01",
                         "--yaw_rate=40",
                         "--yaw_rate_sigma=0.01",
                         "--gravity_sigma=0"};
        all.insert(all.end(), added.begin(), added.end());
        return correct(all);
    }

    // Mean distance of the program's map to the true one, where the raw image shows the pixel and there is no sky.
    double residual(const Arguments& added) const
    {
        const TemporaryFolder folder;
        Arguments all = {"--maps=" + (folder / "maps.yml"), "--report=" + (folder / "report.jsonl")};
        all.insert(all.end(), added.begin(), added.end());
        const Outcome outcome = run(all);
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        cv::Mat map1, map2, columns, rows, mask;
        cv::FileStorage fs(folder / "maps.yml", cv::FileStorage::READ);
        fs["map1"] >> map1;
        fs["map2"] >> map2;
        const rsackermann_samples::Truth truth = rsackermann_samples::readTruth(street("truth.json"));
        const street::StreetRenderer renderer(truth.camera, truth.scene);
        renderer.rectifyMap(columns, rows, mask);
        mask.setTo(0, renderer.globalDepth() == 0);
        for (int y = 0; y < mask.rows; y++)
            for (int x = 0; x < mask.cols; x++)
            {
                cv::Point2d back;
                const cv::Point2d place(columns.at<float>(y, x), rows.at<float>(y, x));
                if (mask.at<uchar>(y, x) &&
                    !(renderer.toGlobal(place, back) && cv::norm(back - cv::Point2d(x, y)) < 0.5))
                    mask.at<uchar>(y, x) = 0;
            }
        cv::Mat distance;
        cv::magnitude(map1 - columns, map2 - rows, distance);
        return cv::mean(distance, mask)[0];
    }

    static TemporaryFolder* folder_;
    const std::string scale = "--depth_scale=0.00390625";
};

TemporaryFolder* CorrectDepth::folder_ = nullptr;

// From version 2 on the header's length has four bytes.
void writeNpy(const std::string& path, const cv::Mat1f& values, const std::string& type = "<f4", int version = 1)
{
    std::string header = cv::format("{'descr': '%s', 'fortran_order': False, 'shape': (%d, %d), }", type.c_str(),
                                    values.rows, values.cols);
    header += std::string(117 - header.size(), ' ') + "\n";
    const std::string magic = "\x93NUMPY";
    writeContent(path, magic + char(version) + '\0' + char(header.size()) + std::string(version == 1 ? 1 : 3, '\0') +
                           header +
                           std::string(reinterpret_cast<const char*>(values.data), values.total() * sizeof(float)));
}

cv::Mat1f relativeOf(const cv::Mat1f& metres)
{
    cv::Mat1f relative(metres.size(), 1.5f); // the sky
    for (int y = 0; y < metres.rows; y++)
        for (int x = 0; x < metres.cols; x++)
            if (metres(y, x) > 0)
                relative(y, x) += 40 / metres(y, x);
    return relative;
}

TEST_F(CorrectDepth, removes_what_the_planes_leave)
{
    EXPECT_GT(residual({}), 0.1);
    EXPECT_LT(residual({"--depth=" + street("rolling_depth.png"), scale}), 0.02);
    EXPECT_LT(residual({"--depth=" + street("global_depth.png"), "--depth_camera=corrected", scale}), 0.02);
}

TEST_F(CorrectDepth, formats_and_kinds)
{
    const TemporaryFolder folder;
    const cv::Mat1f depth = metres("rolling_depth.png");
    for (int version = 1; version <= 3; version++)
    {
        writeNpy(folder / "depth.npy", depth, "<f4", version);
        EXPECT_LT(residual({"--depth=" + (folder / "depth.npy")}), 0.02) << version;
    }

    cv::Mat millimetres;
    cv::Mat(cv::min(depth, 65.f) * 1000).convertTo(millimetres, CV_16U);
    cv::imwrite(folder / "depth.png", millimetres);
    EXPECT_LT(residual({"--depth=" + (folder / "depth.png")}), 0.03);

    if (cv::haveImageWriter("depth.tiff"))
    {
        cv::imwrite(folder / "depth.tiff", depth);
        EXPECT_LT(residual({"--depth=" + (folder / "depth.tiff")}), 0.02);
    }

    // A disparity has less of what is far; the focal length is 816 px.
    cv::Mat1f disparity(depth.size(), 0.f);
    for (int y = 0; y < depth.rows; y++)
        for (int x = 0; x < depth.cols; x++)
            if (depth(y, x) > 0)
                disparity(y, x) = 816 * 0.5f / depth(y, x);
    writeNpy(folder / "disparity.npy", disparity);
    EXPECT_LT(residual({"--depth=" + (folder / "disparity.npy"), "--depth_kind=disparity", "--baseline=0.5"}), 0.02);

    // Half of the size, and half of the disparity
    cv::Mat1f half;
    cv::resize(disparity, half, cv::Size(), 0.5, 0.5, cv::INTER_NEAREST);
    half *= 0.5;
    writeNpy(folder / "half.npy", half);
    EXPECT_LT(residual({"--depth=" + (folder / "half.npy"), "--depth_kind=disparity", "--baseline=0.5"}), 0.06);
}

TEST_F(CorrectDepth, relative)
{
    const TemporaryFolder folder;
    const cv::Mat1f depth = metres("rolling_depth.png");
    const cv::Mat1f relative = relativeOf(depth);
    cv::Mat1f mirrored;
    cv::flip(relative, mirrored, 1);
    writeNpy(folder / "relative.npy", relative);
    writeNpy(folder / "mirrored.npy", mirrored);
    cv::Mat whole;
    relative.convertTo(whole, CV_16U, 1000);
    cv::imwrite(folder / "relative.png", whole);
    const std::string kind = "--depth_kind=relative";
    const double without = residual({});
    EXPECT_LT(residual({"--depth=" + (folder / "relative.npy"), kind}), 0.5 * without);
    EXPECT_LT(residual({"--depth=" + (folder / "relative.png"), kind}), 0.5 * without);
    EXPECT_EQ(without, residual({"--depth=" + (folder / "mirrored.npy"), kind}));

    const Outcome own = run({"--depth=" + (folder / "relative.npy"), kind, "--report=-"}),
                  other = run({"--depth=" + (folder / "mirrored.npy"), kind, "--report=-"});
    EXPECT_NE(std::string::npos, own.output.find("\"depth_used\":true"));
    EXPECT_EQ(std::string::npos, own.messages.find("contradict"));
    EXPECT_EQ(0, other.exitCode) << other.messages;
    EXPECT_NE(std::string::npos, other.output.find("\"depth_used\":false"));
    EXPECT_NE(std::string::npos, other.messages.find("contradict --depth"));

    writeContent(folder / "cut.npy", contentOf(folder / "relative.npy").substr(0, 1000));
    const Outcome cut = run({"--depth=" + (folder / "cut.npy"), kind, "--report=" + (folder / "r.jsonl")});
    EXPECT_EQ(1, cut.exitCode);
    EXPECT_NE(std::string::npos, cut.messages.find(folder / "cut.npy"));
    for (const char* wrong : {"--depth_scale=2", "--depth_camera=corrected"})
        EXPECT_EQ(2, run({"--depth=" + (folder / "relative.npy"), kind, wrong}).exitCode) << wrong;
}

// The points of a sequence agree with the true depths of their frames, and not with mirrored ones.
TEST_F(CorrectDepth, relative_in_sequences)
{
    const TemporaryFolder folder;
    ASSERT_EQ(0, simulate({"--output=" + (folder / "drive"), "--frames=6", "--depth", "--left=7", "--right=6",
                           "--obstacles=12", "--readout=0.03"})
                     .exitCode);
    ASSERT_TRUE(cv::utils::fs::createDirectories(folder / "own"));
    ASSERT_TRUE(cv::utils::fs::createDirectories(folder / "mirrored"));
    const Arguments names = namesIn(folder / "drive/depth");
    ASSERT_EQ(6u, names.size());
    for (const std::string& name : names)
    {
        cv::Mat1f depth;
        cv::imread(folder / ("drive/depth/" + name), cv::IMREAD_UNCHANGED).convertTo(depth, CV_32F, 1. / 256);
        const std::string number = "/" + name.substr(0, name.rfind('.')) + ".npy";
        cv::Mat1f relative = relativeOf(depth);
        writeNpy(folder / ("own" + number), relative);
        cv::flip(relative, relative, 1);
        writeNpy(folder / ("mirrored" + number), relative);
    }
    for (const char* depths : {"own", "mirrored"})
    {
        const Outcome outcome = correct({folder / "drive/frames", "--camera=" + (folder / "drive/camera.yml"),
                                         "--log=" + (folder / "drive/log.csv"), "--carry", "--report=-",
                                         "--depth=" + (folder / depths), "--depth_kind=relative"});
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        EXPECT_EQ(depths == std::string("own"), outcome.output.find("\"depth_used\":true") != std::string::npos)
            << outcome.output;
    }
}

// So it is with depths in metres; of those that err as their scale may, the points show the unit.
TEST_F(CorrectDepth, metres_in_sequences)
{
    const TemporaryFolder folder;
    const std::string drive = folder / "drive";
    ASSERT_EQ(0, simulate({"--output=" + drive, "--frames=6", "--depth", "--left=7", "--right=6", "--obstacles=12",
                           "--readout=0.03"})
                     .exitCode);
    const double factors[] = {1, 1.04, 1.25, 1.5, 0.6};
    for (const char* whose : {"raw", "corrected"}) // both are nearly the same
    {
        cv::Mat1f columns[5];
        for (int i = 0; i < 5; i++)
        {
            SCOPED_TRACE(testing::Message() << whose << " " << factors[i]);
            const std::string maps = folder / cv::format("%s%d/", whose, i);
            const Outcome outcome =
                correct({drive + "/frames", "--camera=" + drive + "/camera.yml", "--log=" + drive + "/log.csv",
                         "--carry", "--report=-", "--scale_from_road", "--depth=" + drive + "/depth",
                         cv::format("--depth_scale=%.9f", factors[i] / 256), std::string("--depth_camera=") + whose,
                         "--maps=" + maps});
            EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
            const nlohmann::json last =
                nlohmann::json::parse(outcome.output.substr(outcome.output.rfind("{\"input\"")));
            EXPECT_EQ(i < 3, last["depth_used"]) << last;
            EXPECT_EQ(i < 3, outcome.messages.find("contradicts verticals or tracked points") == std::string::npos)
                << outcome.messages;
            cv::FileStorage(maps + "000005.yml.gz", cv::FileStorage::READ)["map1"] >> columns[i];
        }
        const cv::Rect below(0, 250, 640, 130); // the road, where an error of 4 % is one of 0.1 px
        for (int i = 1; i < 3; i++)
            EXPECT_LT(cv::norm(columns[0](below), columns[i](below), cv::NORM_L1) / double(below.area()), 0.03);
    }
}

// Points go along with houses elsewhere, too, but not as well as with planes.
TEST_F(CorrectDepth, of_other_frames_of_a_sequence)
{
    const TemporaryFolder folder;
    const std::string drive = folder / "drive";
    const int frames = 20;
    ASSERT_EQ(
        0, simulate({"--output=" + drive, cv::format("--frames=%d", frames), "--depth", "--left=6", "--right=8",
                     "--stagger=1", "--speed=40", "--yaw_rate=12", "--size=480x288", "--focal=430", "--readout=0.03"})
               .exitCode);
    cv::utils::fs::createDirectory(folder / "others");
    for (int i = 0; i < frames; i++)
        writeContent(folder / cv::format("others/%06d.png", i),
                     contentOf(drive + cv::format("/depth/%06d.png", (i + frames / 2) % frames)));
    for (const std::string& depth : {drive + "/depth", folder / "others"})
    {
        const Outcome outcome =
            correct({drive + "/frames", "--camera=" + drive + "/camera.yml", "--log=" + drive + "/log.csv", "--carry",
                     "--report=-", "--speed=40", "--depth=" + depth, "--depth_scale=0.00390625"});
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        int used = 0;
        std::istringstream lines(outcome.output);
        for (std::string line; std::getline(lines, line);)
            used += nlohmann::json::parse(line)["depth_used"].get<bool>();
        if (depth == folder / "others")
            EXPECT_LT(used, frames / 2);
        else
            EXPECT_EQ(frames, used);
    }
}

// What the frames before let expect of one that shows no points is known beside a relative depth, too.
TEST_F(CorrectDepth, relative_of_an_expected_motion)
{
    const street::StreetCamera eye(cv::Size(640, 380), 816, 35e-6, 1.2);
    street::StreetScene scene;
    scene.speed = 60 / 3.6;
    scene.yawRate = 30 * CV_PI / 180;
    scene.obstacles = 15;
    scene.stagger = 1.5;
    street::RenderedDrive drive(eye, scene);
    drive.course = street::RenderedDrive::WEAVING;
    drive.phase = CV_PI / 2; // the yaw rate hardly changes
    const RollingShutterCamera camera = rsackermann_samples::libraryCamera(eye);
    RollingShutterCorrector::Params params;
    params.sequence = true;
    const cv::Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera, params);
    cv::Mat corrected;
    for (int i = 0; i < 5; i++)
        corrector->correct(drive.next().rollingShutter(), corrected);
    const street::StreetRenderer last = drive.next();
    const cv::Mat image = last.rollingShutter(), dark(image.size(), image.type(), cv::Scalar::all(0));
    cv::Mat segments, inverse;
    detectSegments(image, segments);
    cv::divide(1, last.rollingDepth(), inverse); // 0 of the sky
    const AckermannMotion motion = corrector->correctWithSegments(
        dark, segments, corrected, cv::noArray(), DepthMap(inverse * 3 - 1, DEPTH_RAW, 1, DEPTH_RELATIVE));
    ASSERT_FALSE(corrector->isTracked());
    EXPECT_TRUE(corrector->isDepthUsed());
    EXPECT_NEAR(drive.yawRate(), 2 * motion.alpha / camera.secondsPerUnitTime(), 0.02);
}

// Of the true depths 1/256 m are a unit, and no other one that makes images worse.
TEST_F(CorrectDepth, in_another_unit)
{
    const std::string depth = "--depth=" + street("rolling_depth.png");
    const double without = residual({});
    const struct
    {
        const char* scale;
        bool isUsed;
    } units[] = {{"0.00390625", true}, {"0.001", false},    {"0.39", false},
                 {"3.9", false},       {"0.000039", false}, {"0.0000039", false}};
    for (const auto& unit : units)
    {
        SCOPED_TRACE(unit.scale);
        const std::string option = std::string("--depth_scale=") + unit.scale;
        const Outcome outcome = run({depth, option, "--report=-"});
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        EXPECT_EQ(unit.isUsed, outcome.output.find("\"depth_used\":true") != std::string::npos) << outcome.output;
        EXPECT_EQ(!unit.isUsed, outcome.messages.find("in another unit") != std::string::npos) << outcome.messages;
        if (!unit.isUsed)
        {
            EXPECT_EQ(without, residual({depth, option}));
        }
    }
}

// As a disparity without --depth_kind, or a network's output, and what else is no depth of this image.
TEST_F(CorrectDepth, that_the_verticals_contradict)
{
    cv::Mat1f metres;
    cv::imread(street("rolling_depth.png"), cv::IMREAD_UNCHANGED).convertTo(metres, CV_32F, 1. / 256);
    const double without = residual({});
    std::vector<cv::Mat1f> depths(4);
    cv::divide(50, metres, depths[0]);
    cv::flip(metres, depths[1], 0);
    cv::flip(metres, depths[2], 1);
    depths[3] = cv::Mat1f(metres.size(), 10.f);
    for (size_t i = 0; i < depths.size(); i++)
    {
        const std::string file = *folder_ / cv::format("wrong_%d.npy", int(i));
        writeNpy(file, depths[i]);
        const Outcome outcome = run({"--depth=" + file, "--report=-"});
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        EXPECT_NE(std::string::npos, outcome.output.find("\"depth_used\":false")) << i;
        EXPECT_NE(std::string::npos, outcome.messages.find("contradicts verticals")) << i;
        EXPECT_EQ(without, residual({"--depth=" + file})) << i;
    }
}

TEST_F(CorrectDepth, bad_files_are_named_and_others_processed)
{
    const TemporaryFolder folder;
    cv::utils::fs::createDirectories(folder / "in");
    cv::utils::fs::createDirectories(folder / "depth");
    const std::string image = contentOf(street("rolling.png")), depth = contentOf(street("rolling_depth.png"));
    for (const char* name : {"colour", "cut", "good", "missing", "npy", "text"})
        writeContent(folder / ("in/" + std::string(name) + ".png"), image);
    cv::imwrite(folder / "depth/colour.png", cv::Mat(380, 640, CV_8UC3, cv::Scalar::all(9)));
    writeContent(folder / "depth/cut.png", depth.substr(0, 40));
    writeContent(folder / "depth/good.png", depth);
    writeNpy(folder / "depth/npy.npy", cv::Mat1f(380, 640, 5.f), "<i4");
    writeContent(folder / "depth/text.png", "no depth");
    const Outcome outcome =
        correct({folder / "in", "--depth=" + (folder / "depth"), scale, "--camera=" + street("camera.yml"),
                 "--wall=3.2", "--speed=60", "--output=" + (folder / "out"), "--report=" + (folder / "report.jsonl")});
    EXPECT_EQ(1, outcome.exitCode);
    for (const char* name : {"colour.png", "cut.png", "missing.png", "npy.npy", "text.png"})
        EXPECT_NE(std::string::npos, outcome.messages.find(folder / ("depth/" + std::string(name)))) << name;
    EXPECT_EQ((std::vector<std::string>{"good.png"}), namesIn(folder / "out"));
    EXPECT_EQ(6u, linesOf(folder / "report.jsonl").size());
    EXPECT_EQ(depth, contentOf(folder / "depth/good.png"));
}

// Points in the frame of the camera, one for each of some hundred pixels.
TEST_F(CorrectDepth, of_points)
{
    const TemporaryFolder folder;
    const cv::Mat1f depth = metres("global_depth.png");
    cv::Matx33d matrix;
    cv::FileStorage(street("camera.yml"), cv::FileStorage::READ)["camera_matrix"] >> matrix;
    const cv::Matx33d inverse = matrix.inv();
    cv::RNG rng(1);
    std::string table = "file,x,y,z\nrolling.png,nan,nan,NaN\n", millimetres = "z,x,y\n";
    for (int i = 0; i < int(depth.total()) / 100; i++)
    {
        const cv::Point pixel(rng.uniform(0, depth.cols), rng.uniform(0, depth.rows));
        const cv::Vec3d point = inverse * cv::Vec3d(pixel.x, pixel.y, 1) * depth(pixel);
        table += cv::format("rolling.png,%.4f,%.4f,%.4f\n", point[0], point[1], point[2]);
        if (i % 20 == 0)
            millimetres += cv::format("%.1f,%.1f,%.1f\n", 1000 * point[2], 1000 * point[0], 1000 * point[1]);
    }
    const std::string cloud = folder / "cloud.csv", coarse = folder / "millimetres.csv";
    writeContent(cloud, table);
    writeContent(coarse, millimetres);
    const double without = residual({});
    EXPECT_LT(residual({"--depth=" + cloud}), 0.3 * without);
    EXPECT_LT(residual({"--depth=" + coarse, "--depth_scale=0.001"}), 0.8 * without);
    const Outcome unit = run({"--depth=" + coarse, "--report=-"});
    EXPECT_NE(std::string::npos, unit.messages.find("in another unit")) << unit.messages;
    EXPECT_NE(std::string::npos, unit.output.find("\"depth_used\":false"));

    const struct
    {
        std::string content, message;
    } bad[] = {{"x,y\n1,2\n", "a header with x, y and z is needed"},
               {"x,y,z\n1,2,3\n1,2,far\n", "line 3"},
               {"x,y,z\n1,0x2,3\n", "line 2 of " + (folder / "bad.csv") + ", column y: '0x2'"},
               {"x,y,z\n1,2,inf\n", "line 2 of " + (folder / "bad.csv") + ", column z: 'inf'"},
               {"x,y,z\n1,2\n", "line 2"},
               {"x,y,z,file\n1,2,3,a.png\n1,2,3,b.png\n", "each image has its own table"},
               {"", "bad.csv"}};
    for (const auto& entry : bad)
    {
        writeContent(folder / "bad.csv", entry.content);
        const Outcome outcome = run({"--depth=" + (folder / "bad.csv"), "--report=-"});
        EXPECT_EQ(1, outcome.exitCode) << entry.content;
        EXPECT_NE(std::string::npos, outcome.messages.find(entry.message)) << outcome.messages;
    }
    EXPECT_EQ(1, run({"--depth=" + cloud, "--depth_kind=relative", "--report=-"}).exitCode);
}

TEST_F(CorrectDepth, patterns_have_a_file_for_each_image)
{
    const TemporaryFolder folder;
    const std::string image = contentOf(street("rolling.png")), depth = contentOf(street("rolling_depth.png"));
    for (const int i : {3, 4})
    {
        writeContent(folder / cv::format("i_%d.png", i), image);
        writeContent(folder / cv::format("d_%d.png", i), depth);
    }
    const Arguments arguments = {folder / "i_%d.png",
                                 "--depth=" + (folder / "d_%d.png"),
                                 scale,
                                 "--camera=" + street("camera.yml"),
                                 "--wall=3.2",
                                 "--speed=60",
                                 "--report=-"};
    const Outcome outcome = correct(arguments);
    EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
    EXPECT_NE(std::string::npos, outcome.output.find("\"depth_used\":true"));
    std::remove((folder / "d_4.png").c_str());
    EXPECT_EQ(2, correct(arguments).exitCode);
}

TEST_F(CorrectDepth, is_not_replaced)
{
    const std::string depth = street("rolling_depth.png"), content = contentOf(depth);
    for (const char* output : {"--output=", "--overlay=", "--report="})
    {
        const Outcome outcome = run({"--depth=" + depth, scale, output + depth, "--overwrite"});
        EXPECT_EQ(2, outcome.exitCode) << outcome.messages;
        EXPECT_EQ(content, contentOf(depth));
    }
}

// No motion is found in an image whose columns are read one after another; maps by depth with a given one are tested by
// the module.
TEST_F(CorrectDepth, of_a_sensor_that_reads_columns)
{
    const std::string depth = "--depth=" + street("rolling_depth.png"), warning = "--depth has no effect without a "
                                                                                  "sensor that reads rows (--scan)";
    const Outcome rows = run({depth, scale, "--report=-"}),
                  columns = run({depth, scale, "--report=-", "--scan=left_to_right"});
    EXPECT_EQ(0, columns.exitCode);
    EXPECT_NE(std::string::npos, columns.output.find("\"depth_used\":false")) << columns.output;
    EXPECT_NE(std::string::npos, columns.messages.find(warning)) << columns.messages;
    EXPECT_EQ("", rows.messages);
}

TEST_F(CorrectDepth, needs_metres)
{
    const Outcome outcome =
        correct({street("rolling.png"), "--depth=" + street("rolling_depth.png"), scale,
                 "--camera=" + street("camera.yml"), "--yaw_rate=40", "--gravity_sigma=0", "--report=-"});
    EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
    EXPECT_NE(std::string::npos, outcome.output.find("\"depth_used\":false"));
    EXPECT_NE(std::string::npos, outcome.messages.find("--depth has no effect"));
}

}} // namespace opencv_test::
