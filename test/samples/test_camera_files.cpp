// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"
#include "camera_file.hpp"
#include "camera_settings.hpp"
#include "options.hpp"

namespace opencv_test { namespace {

const char* const OPENCV_YAML =
    "%YAML:1.0\n---\nimage_width: 640\nimage_height: 380\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n"
    "   dt: d\n"
    "   data: [ 816., 0., 319.5, 0., 815., 189.5, 0., 0., 1. ]\ndistortion_coefficients: !!opencv-matrix\n   rows: 5\n"
    "   cols: 1\n   dt: d\n   data: [ -0.1, 0.02, 0.001, -0.002, 0.003 ]\n";
const char* const OPENCV_XML =
    "<?xml version=\"1.0\"?>\n<opencv_storage>\n<image_width>640</image_width>\n<image_height>380</image_height>\n"
    "<camera_matrix type_id=\"opencv-matrix\"><rows>3</rows><cols>3</cols><dt>d</dt>\n"
    "<data>816. 0. 319.5 0. 815. 189.5 0. 0. 1.</data></camera_matrix>\n"
    "<distortion_coefficients type_id=\"opencv-matrix\"><rows>1</rows><cols>5</cols><dt>d</dt>\n"
    "<data>-0.1 0.02 0.001 -0.002 0.003</data></distortion_coefficients>\n</opencv_storage>\n";
const char* const ROS =
    "image_width: 640\nimage_height: 380\ncamera_name: front\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
    "  data: [816, 0, 319.5, 0, 815, 189.5, 0, 0, 1]\ndistortion_model: plumb_bob\ndistortion_coefficients:\n"
    "  rows: 1\n  cols: 5\n"
    "  data: [-0.1, 0.02, 0.001, -0.002, 0.003]\n";
const char* const ROS_MESSAGE =
    "height: 380\nwidth: 640\ndistortion_model: plumb_bob\nD: [-0.1, 0.02, 0.001, -0.002, 0.003]\n"
    "K: [816, 0, 319.5, 0, 815, 189.5, 0, 0, 1]\n";
// Of an anamorphic lens: calibrated with images that were stretched to 960 x 380, as others of 640 x 380.
const char* const GYROFLOW = R"({
  "name": "front", "calib_dimension": {"w": 960, "h": 380}, "orig_dimension": {"w": 960, "h": 380},
  "output_dimension": {"w": 960, "h": 380}, "frame_readout_time": 19.0, "input_horizontal_stretch": 1.5,
  "input_vertical_stretch": 1.0, "num_images": 14, "fps": 30.0, "crop": null, "asymmetrical": false,
  "fisheye_params": {"RMS_error": 0.7, "camera_matrix": [[750, 0, 470], [0, 500, 180], [0, 0, 1]],
  "distortion_coeffs": [0.25, -0.08, 0.22, -0.11], "radial_distortion_limit": null},
  "compatible_settings": [], "distortion_model": null, "digital_lens": null, "global_shutter": false
})";
const char* const KALIBR =
    "cam0:\n  camera_model: pinhole\n  intrinsics: [816, 815, 319.5, 189.5]\n  distortion_model: radtan\n"
    "  distortion_coeffs: [-0.1, 0.02, 0.001, -0.002]\n  resolution: [640, 380]\n"
    "cam1:\n  camera_model: pinhole\n  intrinsics: [1, 1, 1, 1]\n";

rsackermann_samples::CameraSettings read(const std::string& content)
{
    const TemporaryFolder folder;
    writeContent(folder / "camera", content);
    rsackermann_samples::CameraSettings settings;
    rsackermann_samples::readCameraFile(folder / "camera", settings);
    return settings;
}

class CameraFile : public testing::TestWithParam<const char*>
{
};

TEST_P(CameraFile, intrinsics)
{
    const rsackermann_samples::CameraSettings s = read(GetParam());
    EXPECT_TRUE(s.calibrated);
    EXPECT_EQ(cv::Size(640, 380), s.size);
    EXPECT_EQ(cv::Matx33d(816, 0, 319.5, 0, 815, 189.5, 0, 0, 1), s.K);
    const double lens[] = {-0.1, 0.02, 0.001, -0.002, 0.003};
    ASSERT_EQ(GetParam() == KALIBR ? 4u : 5u, s.lens.size());
    for (size_t i = 0; i < s.lens.size(); i++)
        EXPECT_EQ(lens[i], s.lens[i]);
    EXPECT_EQ(cv::rsackermann::LENS_PINHOLE, s.lensModel);
}

INSTANTIATE_TEST_CASE_P(Samples, CameraFile, testing::Values(OPENCV_YAML, OPENCV_XML, ROS, ROS_MESSAGE, KALIBR));

// Editors put it before UTF-8.
TEST(CameraFiles, mark_before_the_text)
{
    for (const char* content : {OPENCV_YAML, OPENCV_XML, ROS, ROS_MESSAGE, GYROFLOW, KALIBR})
    {
        const rsackermann_samples::CameraSettings plain = read(content),
                                                  marked = read("\xEF\xBB\xBF" + std::string(content));
        EXPECT_EQ(plain.K, marked.K) << content;
        EXPECT_EQ(plain.lens, marked.lens) << content;
        EXPECT_EQ(plain.readOut, marked.readOut) << content;
    }
}

TEST(CameraFiles, shutter_and_mounting)
{
    for (const char* content : {OPENCV_YAML, ROS})
    {
        const rsackermann_samples::CameraSettings s =
            read(std::string(content) + "line_delay: 3.5e-5\nscan: bottom_to_top\nreference: 17\nroll: 1.5\npitch: -2\n"
                                        "heading: 90\ncamera_height: 1.25\nfocal_sigma: 8\nline_delay_sigma: 1e-6\n");
        EXPECT_EQ(3.5e-5, s.lineDelay);
        EXPECT_EQ(cv::rsackermann::SCAN_BOTTOM_TO_TOP, s.scan);
        const cv::rsackermann::RollingShutterCamera camera = s.makeCamera(s.size);
        EXPECT_EQ(17, camera.referenceRow);
        EXPECT_EQ(3.5e-5, camera.lineDelay);
        EXPECT_DOUBLE_EQ(CV_PI / 2, camera.heading);
        EXPECT_EQ(1.25, camera.height);
        EXPECT_EQ(8, camera.focalSigma);
        EXPECT_EQ(1e-6, camera.lineDelaySigma);
        EXPECT_EQ(1.5, s.roll);
        EXPECT_EQ(-2, s.pitch);
    }
    const rsackermann_samples::CameraSettings s = read(std::string(ROS) + "readout: 0.019\n");
    EXPECT_DOUBLE_EQ(0.019 / 380, s.makeCamera(s.size).lineDelay);
}

// The words are those of the time at which lines are read, in whichever order.
TEST(CameraFiles, reference_of_each_shutter)
{
    const std::pair<const char*, double> words[] = {{"first", 0}, {"middle", 0.5}, {"last", 1}};
    for (const std::string& scan : rsackermann_samples::SCAN_WORDS)
        for (const auto& word : words)
        {
            SCOPED_TRACE(scan + " " + word.first);
            const rsackermann_samples::CameraSettings s =
                read(std::string(ROS) + "scan: " + scan + "\nreference: " + word.first + "\n");
            const cv::rsackermann::RollingShutterCamera camera = s.makeCamera(s.size);
            const double corner = camera.rowTime(cv::Point2d()),
                         opposite = camera.rowTime(cv::Point2d(s.size.width - 1, s.size.height - 1)),
                         first = std::min(corner, opposite), last = std::max(corner, opposite);
            EXPECT_GT(last, first);
            EXPECT_NEAR(0, first + word.second * (last - first), 1e-9);
        }
}

// It is the time of all lines, whichever way they lie.
TEST(CameraFiles, read_out_of_each_shutter)
{
    for (const std::string& scan : rsackermann_samples::SCAN_WORDS)
    {
        const rsackermann_samples::CameraSettings s = read(std::string(ROS) + "scan: " + scan + "\nreadout: 0.03\n");
        const cv::Size size = s.size;
        const int lines = scan.find("left") == std::string::npos ? size.height : size.width;
        EXPECT_NEAR(0.03 / lines, s.makeCamera(size).lineDelay, 1e-12) << scan;
    }
}

// What an option says is exact, and of all else the file's standard deviation stays.
TEST(CameraFiles, options_replace_values_and_their_sigmas)
{
    using rsackermann_samples::CameraSettings;
    const TemporaryFolder folder;
    const std::string file = "--camera=" + (folder / "camera.yml");
    writeContent(folder / "camera.yml", std::string(OPENCV_YAML) +
                                            "line_delay: 3.5e-5\nroll: 1.5\npitch: -2\nheading: 90\nroll_sigma: 0.1\n"
                                            "pitch_sigma: 0.2\nheading_sigma: 0.3\nline_delay_sigma: 1e-6\n");
    const struct
    {
        const char *option, *value;
        double CameraSettings::*setting;
        double CameraSettings::*sigma;
    } options[] = {{"roll", "1", &CameraSettings::roll, &CameraSettings::rollSigma},
                   {"pitch", "2", &CameraSettings::pitch, &CameraSettings::pitchSigma},
                   {"heading", "3", &CameraSettings::heading, &CameraSettings::headingSigma},
                   {"line_delay", "0.00004", &CameraSettings::lineDelay, &CameraSettings::lineDelaySigma},
                   {"readout", "0.01", &CameraSettings::readOut, &CameraSettings::lineDelaySigma}};
    const auto settingsWith = [&](const std::string& option) {
        std::vector<const char*> arguments = {"program", file.c_str()};
        if (!option.empty())
            arguments.push_back(option.c_str());
        return rsackermann_samples::readCameraOptions(
            rsackermann_samples::Options(int(arguments.size()), arguments.data(), rsackermann_samples::CAMERA_KEYS));
    };
    const CameraSettings ofFile = settingsWith("");
    for (const auto& given : options)
    {
        SCOPED_TRACE(given.option);
        const CameraSettings s = settingsWith(std::string("--") + given.option + "=" + given.value);
        EXPECT_EQ(std::stod(given.value), s.*given.setting);
        for (const auto& other : options)
        {
            EXPECT_GT(ofFile.*other.sigma, 0);
            EXPECT_EQ(other.sigma == given.sigma ? 0 : ofFile.*other.sigma, s.*other.sigma) << other.option;
        }
    }
}

TEST(CameraFiles, fisheye)
{
    EXPECT_EQ(cv::rsackermann::LENS_FISHEYE,
              read("width: 640\nheight: 380\ndistortion_model: equidistant\nd: [0.1, 0, 0, 0]\n"
                   "k: [500, 0, 319.5, 0, 500, 189.5, 0, 0, 1]\n")
                  .lensModel);
    EXPECT_EQ(cv::rsackermann::LENS_FISHEYE,
              read("cam0:\n  camera_model: pinhole\n  intrinsics: [500, 500, 319.5, 189.5]\n"
                   "  distortion_model: equidistant\n  distortion_coeffs: [0.1, 0, 0, 0]\n")
                  .lensModel);
    EXPECT_EQ(cv::rsackermann::LENS_FISHEYE,
              read("width: 640\nheight: 380\ndistortion_model: fisheye\nd: [0.1, 0, 0, 0]\n"
                   "k: [500, 0, 319.5, 0, 500, 189.5, 0, 0, 1]\n")
                  .lensModel);
}

// ROS writes a directive %YAML as well; the lens model's own key counts, whatever the format.
TEST(CameraFiles, lens_model_by_its_own_key)
{
    const std::string ros = "image_width: 640\nimage_height: 380\ncamera_matrix:\n   rows: 3\n   cols: 3\n"
                            "   data: [500, 0, 319.5, 0, 500, 189.5, 0, 0, 1]\n"
                            "distortion_coefficients:\n   rows: 1\n   cols: 4\n   data: [0.1, 0, 0, 0]\n";
    const std::string opencv =
        "%YAML:1.0\n---\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
        "   data: [ 500., 0., 319.5, 0., 500., 189.5, 0., 0., 1. ]\ndistortion_coefficients: !!opencv-matrix\n"
        "   rows: 4\n"
        "   cols: 1\n   dt: d\n   data: [ 0.1, 0., 0., 0. ]\n";
    for (const std::string& content : {"%YAML:1.0\n---\n" + ros, "%YAML 1.2\n---\n" + ros, ros, opencv})
    {
        EXPECT_EQ(cv::rsackermann::LENS_FISHEYE, read(content + "distortion_model: equidistant\n").lensModel)
            << content;
        EXPECT_EQ(cv::rsackermann::LENS_PINHOLE, read(content + "distortion_model: plumb_bob\n").lensModel) << content;
        EXPECT_THROW(read(content + "distortion_model: magic\n"), rsackermann_samples::UsageError) << content;
        EXPECT_EQ(500, read(content).K(0, 0));
    }
    EXPECT_EQ(cv::rsackermann::LENS_FISHEYE, read(opencv + "fisheye_model: 1\n").lensModel);
    EXPECT_EQ(cv::rsackermann::LENS_PINHOLE, read(opencv + "fisheye_model: 0\n").lensModel);
    for (const char* value : {"\"no\"", "no", "2", "-1", "0.5", "[ 1 ]"})
        EXPECT_THROW(read(opencv + "fisheye_model: " + value + "\n"), rsackermann_samples::UsageError) << value;
}

TEST(CameraFiles, sizes)
{
    const std::string opencv = std::string(OPENCV_YAML).substr(0, std::string(OPENCV_YAML).find("image_width")) +
                               std::string(OPENCV_YAML).substr(std::string(OPENCV_YAML).find("camera_matrix"));
    const std::string ros = "K: [500, 0, 319.5, 0, 500, 189.5, 0, 0, 1]\n";
    EXPECT_EQ(cv::Size(), read(opencv).size);
    EXPECT_EQ(cv::Size(), read(ros).size);
    for (const char* size : {"65536 65536", "65535 65535", "0 380", "-640 -380", "640.5 380", "640 many", "1e9 1"})
    {
        std::istringstream words(size);
        std::string width, height;
        words >> width >> height;
        EXPECT_THROW(read(opencv + "image_width: " + width + "\nimage_height: " + height + "\n"),
                     rsackermann_samples::UsageError)
            << size;
        EXPECT_THROW(read(ros + "width: " + width + "\nheight: " + height + "\n"), rsackermann_samples::UsageError)
            << size;
    }
    EXPECT_THROW(read(opencv + "image_width: 640\n"), rsackermann_samples::UsageError);
    EXPECT_THROW(read(ros + "height: 640\n"), rsackermann_samples::UsageError);
    EXPECT_EQ(cv::Size(8192, 4096), read(opencv + "image_width: 8192\nimage_height: 4096\n").size);
}

// What would end a parser never gets there.
TEST(CameraFiles, nested_or_large)
{
    std::string dashes, tags = "<?xml version=\"1.0\"?>\n<opencv_storage>";
    for (int i = 0; i < 100000; i++)
    {
        dashes += "- ";
        tags += "<a>";
    }
    for (const std::string& content :
         {"a: " + std::string(300000, '['), "%YAML:1.0\n---\na: " + std::string(300000, '['), std::string(300000, '{'),
          "%YAML:1.0\n---\n#opencv-matrix\na: " + std::string(300000, '['), "a:\n  " + dashes + "1\n",
          "%YAML:1.0\n---\n#opencv-matrix\na:\n  " + dashes + "1\n", tags,
          std::string(OPENCV_YAML) + "#" + std::string(2000000, 'x') + "\n"})
        EXPECT_THROW(read(content), rsackermann_samples::UsageError) << content.substr(0, 60);
    // Indentation: as deep as the size allows.
    std::string indented;
    for (int i = 0; i < 1400; i++)
        indented += std::string(size_t(i), ' ') + "a:\n";
    EXPECT_THROW(read(indented + std::string(1400, ' ') + "1\n"), rsackermann_samples::UsageError);
    EXPECT_THROW(read("%YAML:1.0\n---\n#opencv-matrix\n" + indented + std::string(1400, ' ') + "1\n"),
                 rsackermann_samples::UsageError);
}

// OpenCV's parser doesn't come to the end of some of these.
TEST(CameraFiles, one_map_and_nothing_else)
{
    const std::string map = "a: 1\n";
    for (const std::string& content :
         {"   " + map + "abc-d: 2\n", "--- " + map + "abc-d: 2\n", map + "...-d\n", map + "...\n- d\n",
          std::string("[ 1 ]\nabc-d: 2\n"), std::string("{ a: 1 }\nabc-d: 2\n"), map + "...\n---\n" + map})
        try
        {
            read("%YAML:1.0\n---\n" + content + "#opencv-matrix\n");
            ADD_FAILURE() << content;
        }
        catch (const rsackermann_samples::UsageError& e)
        {
            EXPECT_EQ(std::string::npos, std::string(e.what()).find("parse")) << content << e.what();
        }
    const std::string rest = std::string(OPENCV_YAML).substr(std::string("%YAML:1.0\n---\n").size());
    EXPECT_EQ(816, read("%YAML:1.0\n# camera\n---\n\n" + rest + "...\n").K(0, 0));
}

// One of several is taken, with a warning of the program.
TEST(CameraFiles, cameras_of_a_camchain)
{
    const auto camera = [](const std::string& name, int focal) {
        return cv::format("%s:\n  camera_model: pinhole\n  intrinsics: [%d, %d, 319.5, 189.5]\n", name.c_str(), focal,
                          focal);
    };
    const struct
    {
        std::string content, several;
        double focal;
    } cases[] = {{camera("cam0", 800), "", 800},
                 {camera("cam1", 900), "", 900},
                 {camera("cam1", 900) + camera("cam0", 800) + camera("cam2", 700), "cam0, cam1, cam2: cam0", 800}};
    for (const auto& c : cases)
    {
        const rsackermann_samples::CameraSettings s = read(c.content);
        EXPECT_EQ(c.focal, s.K(0, 0)) << c.content;
        EXPECT_EQ(c.several, s.severalCameras) << c.content;
    }
    const TemporaryFolder folder;
    writeContent(folder / "chain.yaml", cases[2].content);
    const std::string messages =
        correct({streetFolder() + "/rolling.png", "--report=-", "--camera=" + (folder / "chain.yaml")}).messages;
    EXPECT_NE(std::string::npos, messages.find("the camera file has the cameras cam0, cam1, cam2: cam0 is taken"))
        << messages;
}

// A roll beyond those of any mount is said to be one, and what to do, in the unit of the file.
TEST(CameraFiles, mounted_upside_down_or_on_its_side)
{
    const TemporaryFolder folder;
    for (const char* roll : {"180.", "90.", "-90."})
    {
        writeContent(folder / "camera.yml", std::string(OPENCV_YAML) + "roll: " + roll + "\n");
        rsackermann_samples::CameraSettings settings;
        try
        {
            rsackermann_samples::readCameraFile(folder / "camera.yml", settings);
            FAIL() << roll;
        }
        catch (const rsackermann_samples::UsageError& e)
        {
            const std::string message = e.what();
            EXPECT_NE(std::string::npos, message.find("is not from -89 to 89")) << message;
            EXPECT_NE(std::string::npos, message.find("turn the images")) << message;
        }
    }
}

// Of a value that a file has, or the options.
std::string refusalOf(const std::string& keys, const Arguments& options = Arguments())
{
    const TemporaryFolder folder;
    writeContent(folder / "camera.yml", ROS + keys);
    const std::string file = "--camera=" + (folder / "camera.yml");
    std::vector<const char*> arguments = {"program", file.c_str()};
    for (const std::string& option : options)
        arguments.push_back(option.c_str());
    try
    {
        rsackermann_samples::readCameraOptions(
            rsackermann_samples::Options(int(arguments.size()), arguments.data(), rsackermann_samples::CAMERA_KEYS));
        return "";
    }
    catch (const rsackermann_samples::UsageError& e)
    {
        return e.what();
    }
}

// Of a file and of the option of the same meaning, if there is one.
TEST(CameraFiles, ranges_of_values)
{
    const struct
    {
        const char *key, *option, *least, *most, *tooSmall, *tooLarge, *range;
    } cases[] = {{"roll", "roll", "-89", "89", "-89.5", "89.5", "-89 to 89"},
                 {"pitch", "pitch", "-89", "89", "-89.5", "89.5", "-89 to 89"},
                 {"heading", "heading", "-180", "180", "-181", "400", "-180 to 180"},
                 {"camera_height", "height", "0.3", "1000", "-1", "1200", "to 1000"},
                 {"line_delay", "line_delay", "1e-6", "2e-3", "-1", "2", "to 1"},
                 {"readout", "readout", "2e-3", "1", "-0.1", "30", "to 1"},
                 {"focal_sigma", "focal_sigma", "1e-9", "1e7", "-1", "2e7", "to 10000000"},
                 {"reference", "reference", "-1e9", "1e9", "-2e9", "2e9", "-1000000000 to 1000000000"},
                 {"roll_sigma", "", "0", "45", "-1", "46", "0 to 45"},
                 {"pitch_sigma", "", "0", "45", "-1", "46", "0 to 45"},
                 {"heading_sigma", "", "0", "180", "-1", "181", "0 to 180"},
                 {"line_delay_sigma", "", "0", "1", "-1", "1.5", "0 to 1"}};
    for (const auto& c : cases)
        for (const std::string value : {c.least, c.most, c.tooSmall, c.tooLarge})
        {
            const bool isAccepted = value == c.least || value == c.most;
            std::vector<std::string> refusals = {refusalOf(std::string(c.key) + ": " + value + "\n")};
            SCOPED_TRACE(c.key + (": " + value) + ": " + refusals[0]);
            const std::string ofFile = "/camera.yml: " + std::string(c.key) + " (";
            EXPECT_NE(isAccepted, refusals[0].find(ofFile) != std::string::npos);
            if (*c.option)
                refusals.push_back(refusalOf("", {std::string("--") + c.option + "=" + value}));
            for (const std::string& refusal : refusals)
            {
                EXPECT_EQ(isAccepted, refusal.empty()) << refusal;
                EXPECT_NE(isAccepted, refusal.find(" is not from ") != std::string::npos) << refusal;
                EXPECT_NE(isAccepted, refusal.find(c.range) != std::string::npos) << refusal;
            }
        }
}

// A matrix alone is evidently not that of larger or smaller images, whose centre is elsewhere.
TEST(CameraFiles, matrix_of_images_of_another_size)
{
    const std::string matrix = "camera_matrix: [816, 0, 319.5, 0, 815, 189.5, 0, 0, 1]\n";
    for (const std::string& file : {matrix, std::string("cam0:\n  camera_model: pinhole\n  intrinsics: [816, 815, "
                                                        "319.5, 189.5]\n")})
    {
        const rsackermann_samples::CameraSettings s = read(file);
        // 253 lines are left of 380 if a third is cut off, at the top or at the bottom.
        for (const cv::Size& size : {cv::Size(640, 380), cv::Size(640, 253), cv::Size(720, 420)})
            EXPECT_EQ(319.5, s.makeCamera(size).cameraMatrix(0, 2)) << size;
        for (const cv::Size& size :
             {cv::Size(1280, 760), cv::Size(960, 570), cv::Size(427, 253), cv::Size(320, 190), cv::Size(640, 190)})
            EXPECT_THROW(s.makeCamera(size), rsackermann_samples::InputError) << size;
    }
    try
    {
        read(matrix).makeCamera(cv::Size(320, 190));
        FAIL();
    }
    catch (const rsackermann_samples::InputError& e)
    {
        const std::string message = e.what();
        EXPECT_NE(std::string::npos, message.find("principal point (319.5, 189.5)")) << message;
        EXPECT_NE(std::string::npos, message.find("320 x 190")) << message;
        EXPECT_NE(std::string::npos, message.find("no image_width and image_height")) << message;
    }
    // Who says of which size it is, is believed.
    EXPECT_EQ(319.5, read(matrix + "image_width: 320\nimage_height: 190\n").makeCamera({320, 190}).cameraMatrix(0, 2));
}

// OpenCV would take 51 GB, or refuse them in its own words, before it sees that there is one element.
TEST(CameraFiles, size_of_matrices)
{
    const TemporaryFolder folder;
    for (const char* size : {"rows: 80000\n   cols: 80000", "rows: -80000\n   cols: -80000",
                             "rows: -1\n   cols: -1\n   sizes: [ 80000, 80000 ]", "rows: 3\n   cols: 5"})
        for (const char* key : {"camera_matrix", "distortion_coefficients"})
        {
            std::string content = OPENCV_YAML;
            const size_t at = content.find("rows", content.find(key)), end = content.find("\n   dt", at);
            content.replace(at, end - at, size);
            writeContent(folder / "camera.yml", content);
            rsackermann_samples::CameraSettings settings;
            try
            {
                rsackermann_samples::readCameraFile(folder / "camera.yml", settings);
                FAIL() << content;
            }
            catch (const rsackermann_samples::UsageError& e)
            {
                const std::string message = e.what();
                EXPECT_NE(std::string::npos, message.find("camera file " + (folder / "camera.yml") + ": " + key))
                    << message;
                EXPECT_NE(std::string::npos, message.find("a matrix of up to 14 elements is accepted")) << message;
            }
        }
}

TEST(CameraFiles, broken)
{
    const std::string opencv = OPENCV_YAML, ros = ROS;
    for (const std::string& content : std::vector<std::string>{
             "",
             "hello",
             "a: [1, 2",
             "image_width: 640\n",
             "%YAML:1.0\n---\nx: 1\n",
             opencv.substr(0, opencv.size() / 2),
             "cam0:\n  camera_model: omni\n  intrinsics: [1, 1, 1, 1]\n",
             "cam0:\n  camera_model: pinhole\n  intrinsics: [1, 1]\n",
             "camera_matrix: {data: [1, 2, 3]}\n",
             "camera_matrix: {data: [a, b, c]}\n",
             ros + "scan: sideways\n",
             ros + "line_delay: 1e-5\nreadout: 0.01\n",
             ros + "line_delay: -1\n",
             ros + "readout: 30\n",
             ros + "roll: much\n",
             opencv + "roll: much\n",
             ros + "reference: half\n",
             "width: 640\nheight: 380\ndistortion_model: magic\nK: [500, 0, 319.5, 0, 500, 189.5, 0, 0, 1]\n",
             "width: 640\nheight: 380\nK: [-500, 0, 319.5, 0, 500, 189.5, 0, 0, 1]\n",
             "width: 640\nheight: 380\nD: [1]\nK: [500, 0, 319.5, 0, 500, 189.5, 0, 0, 1]\n",
             opencv + "line_delay: \"a\"\n",
             opencv + "heading: [ 1 ]\n",
             opencv + "roll: .Nan\n",
             ros + "roll: .nan\n",
             ros + "heading: .inf\n",
             ros + "line_delay: 20\n",
             ros + "readout: 0.02\nreadout: 0.03\n",
             opencv + "readout: 0.02\nreadout: 0.03\n",
             "width: 640\nheight: 380\nK: [500, 0, 1300, 0, 500, 189.5, 0, 0, 1]\n",
             "width: 640\nheight: 380\nK: [500, 0, 319.5, 0, 500, -400, 0, 0, 1]\n",
             "%YAML:1.0\n---\ncamera_matrix: \"opencv-matrix\"\n",
             "%YAML:1.0\n---\ncamera_matrix: 5\n#opencv-matrix\n",
             "%YAML:1.0\n---\ncamera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
             "   data: [ 1., a, 1., 0., 1., 1., 0., 0., 1. ]\n",
             "%YAML:1.0\n---\ncamera_matrix: !!opencv-matrix\n   rows: 300000\n   cols: 300000\n   dt: d\n"
             "   data: [ 1. ]\n"})
        EXPECT_THROW(read(content), rsackermann_samples::UsageError) << content;
}

TEST(CameraFiles, written_and_read)
{
    rsackermann_samples::CameraSettings s = read(OPENCV_YAML);
    const std::vector<double> lens = s.lens;
    s.readOut = 0.0123;
    s.scan = cv::rsackermann::SCAN_RIGHT_TO_LEFT;
    s.reference = "first";
    s.roll = 1;
    s.pitch = 2;
    s.rollIsGiven = s.pitchIsGiven = s.headingIsGiven = true;
    s.heading = 3;
    s.height = 4;
    const std::pair<const char*, const char*> formats[] = {
        {"camera.yml", "%YAML"}, {"camera.yaml", "%YAML"}, {"camera.xml", "<?xml"}, {"camera.JSON", "{"}};
    for (const auto& format : formats)
        for (const bool hasLens : {true, false})
        {
            SCOPED_TRACE(testing::Message() << format.first << (hasLens ? "" : " without a lens"));
            s.lens = hasLens ? lens : std::vector<double>();
            const TemporaryFolder folder;
            const std::string path = folder / format.first;
            rsackermann_samples::writeCameraFile(path, s);
            EXPECT_EQ(0u, contentOf(path).find(format.second));
            rsackermann_samples::CameraSettings r;
            rsackermann_samples::readCameraFile(path, r);
            EXPECT_EQ(s.K, r.K);
            EXPECT_EQ(s.lens, r.lens);
            EXPECT_EQ(s.size, r.size);
            EXPECT_EQ(s.readOut, r.readOut);
            EXPECT_EQ(s.scan, r.scan);
            EXPECT_EQ(s.reference, r.reference);
            EXPECT_EQ(s.roll, r.roll);
            EXPECT_EQ(s.pitch, r.pitch);
            EXPECT_EQ(s.heading, r.heading);
            EXPECT_EQ(s.height, r.height);
        }
}

// A mount that nobody knows isn't level when it is read again.
TEST(CameraFiles, unknown_mount_stays_unknown)
{
    const TemporaryFolder folder;
    using rsackermann_samples::CameraSettings;
    bool CameraSettings::*const all[] = {&CameraSettings::rollIsGiven, &CameraSettings::pitchIsGiven,
                                         &CameraSettings::headingIsGiven};
    for (bool CameraSettings::*const one : all)
    {
        CameraSettings s = read(OPENCV_YAML), r;
        for (bool CameraSettings::*const given : all)
            s.*given = given == one;
        rsackermann_samples::writeCameraFile(folder / "camera.yml", s);
        rsackermann_samples::readCameraFile(folder / "camera.yml", r);
        for (bool CameraSettings::*const given : all)
            EXPECT_EQ(given == one, r.*given);
        EXPECT_EQ(!(r.headingIsGiven), r.makeCamera(s.size).headingSigma > 0);
    }
}

// A profile with another value of a field; null takes it away.
std::string profileWith(const std::string& pointer, const nlohmann::json& value)
{
    nlohmann::json profile = nlohmann::json::parse(GYROFLOW);
    profile[nlohmann::json::json_pointer(pointer)] = value;
    return profile.dump();
}

TEST(CameraFiles, lens_profile)
{
    const rsackermann_samples::CameraSettings s = read(GYROFLOW);
    EXPECT_EQ(cv::Size(640, 380), s.size);
    EXPECT_EQ(cv::rsackermann::LENS_FISHEYE, s.lensModel);
    EXPECT_EQ(std::vector<double>({0.25, -0.08, 0.22, -0.11}), s.lens);
    EXPECT_EQ(cv::rsackermann::SCAN_TOP_TO_BOTTOM, s.scan);
    const cv::rsackermann::RollingShutterCamera same = s.makeCamera(s.size);
    EXPECT_LT(cv::norm(same.cameraMatrix - cv::Matx33d(500, 0, 319.5, 0, 500, 189.5, 0, 0, 1)), 1e-9);
    EXPECT_DOUBLE_EQ(0.019 / 380, same.lineDelay);
    // Twice as large: the read-out takes as long.
    const cv::rsackermann::RollingShutterCamera twice = s.makeCamera(cv::Size(1280, 760));
    EXPECT_LT(cv::norm(twice.cameraMatrix - cv::Matx33d(1000, 0, 639.5, 0, 1000, 379.5, 0, 0, 1)), 1e-9);
    EXPECT_DOUBLE_EQ(0.019 / 760, twice.lineDelay);
    // Sizes that are rounded to even numbers.
    EXPECT_NEAR(500 * 424 / 640., s.makeCamera(cv::Size(424, 252)).cameraMatrix(0, 0), 1e-9);
    EXPECT_THROW(s.makeCamera(cv::Size(960, 380)), rsackermann_samples::InputError);
}

TEST(CameraFiles, lens_profile_fields)
{
    const cv::Matx33d asymmetrical(500, 0, (470 + 0.5) / 1.5 - 0.5, 0, 500, 180, 0, 0, 1);
    EXPECT_LT(cv::norm(read(profileWith("/asymmetrical", true)).K - asymmetrical), 1e-9);
    EXPECT_EQ(625, read(profileWith("/crop", 0.8)).K(1, 1));
    EXPECT_EQ(cv::Size(960, 380), read(profileWith("/input_horizontal_stretch", 0)).size);
    EXPECT_EQ(cv::Size(640, 190), read(profileWith("/input_vertical_stretch", 2)).size);
    EXPECT_EQ(0, read(profileWith("/frame_readout_time", nullptr)).readOut);
    const rsackermann_samples::CameraSettings upwards = read(profileWith("/frame_readout_time", -25));
    EXPECT_EQ(0.025, upwards.readOut);
    EXPECT_EQ(cv::rsackermann::SCAN_BOTTOM_TO_TOP, upwards.scan);
    EXPECT_EQ(cv::rsackermann::SCAN_RIGHT_TO_LEFT, read(profileWith("/frame_readout_direction", "RightToLeft")).scan);
    for (const size_t count : {4, 5, 8, 12})
    {
        nlohmann::json standard = nlohmann::json::parse(profileWith("/distortion_model", "opencv_standard"));
        standard["fisheye_params"]["distortion_coeffs"] = std::vector<double>(count, 1e-4);
        const rsackermann_samples::CameraSettings s = read(standard.dump());
        EXPECT_EQ(cv::rsackermann::LENS_PINHOLE, s.lensModel);
        EXPECT_EQ(count, s.lens.size());
    }
}

// Of an action camera that reads all of its sensor, the middle of it, or every other pixel.
const char* const GYROFLOW_MODES = R"({
  "calib_dimension": {"w": 2704, "h": 2028}, "frame_readout_time": 16, "fisheye_params": {
  "camera_matrix": [[1200, 0, 1340], [0, 1210, 1000], [0, 0, 1]], "distortion_coeffs": [0.03, 0.05, -0.04, 0.01]},
  "compatible_settings": [
    {"width": 2704, "height": 1520, "fps": 60},
    {"width": 2704, "height": 1520, "fps": 30, "crop": 0.9},
    {"width": 1920, "height": 1440, "frame_readout_time": 12, "distortion_coeffs": [0.02, 0.05, -0.04, 0.01]},
    {"width": 2560, "height": 1200, "digital_lens": "gopro_superview"},
    {"width": 1200, "height": 1200, "frame_readout_time": 9},
    {"width": 1200, "height": 1200, "frame_readout_time": 8},
    {"crop": 0.5, "identifier": "zoomed"}]
})";

// https://github.com/gyroflow/gyroflow: the first one of that size, else of that shape; another shape is a part of the
// sensor, the same one other pixels.
TEST(CameraFiles, lens_profile_of_several_modes)
{
    const rsackermann_samples::CameraSettings s = read(GYROFLOW_MODES);
    const struct
    {
        cv::Size size;
        cv::Matx33d K;
        double readOut, lens;
    } cases[] = {{{2704, 2028}, {1200, 0, 1351.5, 0, 1210, 1013.5, 0, 0, 1}, 0.016, 0.03},
                 {{1352, 1014}, {600, 0, 675.5, 0, 605, 506.5, 0, 0, 1}, 0.016, 0.03},
                 {{2704, 1520}, {1200, 0, 1351.5, 0, 1210, 759.5, 0, 0, 1}, 0.016, 0.03},
                 {{1352, 760}, {600, 0, 675.5, 0, 605, 379.5, 0, 0, 1}, 0.016, 0.03},
                 {{1920, 1440}, {1200 * 1920 / 2704., 0, 959.5, 0, 1210 * 1440 / 2028., 719.5, 0, 0, 1}, 0.012, 0.02}};
    for (const auto& c : cases)
    {
        SCOPED_TRACE(c.size);
        const cv::rsackermann::RollingShutterCamera camera = s.makeCamera(c.size);
        EXPECT_LT(cv::norm(camera.cameraMatrix - c.K), 1e-9);
        EXPECT_DOUBLE_EQ(c.readOut / c.size.height, camera.lineDelay);
        EXPECT_EQ(c.lens, camera.distCoeffs[0]);
        EXPECT_EQ(c.lens, s.forSize(c.size).lens[0]); // of rsackermann_calibrate
    }
    // The sign of a mode's time is the direction of its read-out.
    nlohmann::json upwards = nlohmann::json::parse(GYROFLOW_MODES);
    upwards["compatible_settings"][2]["frame_readout_time"] = -12;
    EXPECT_EQ(cv::rsackermann::SCAN_BOTTOM_TO_TOP, read(upwards.dump()).makeCamera(cv::Size(1920, 1440)).scanDirection);
    EXPECT_EQ(cv::rsackermann::SCAN_TOP_TO_BOTTOM, read(upwards.dump()).makeCamera(cv::Size(2704, 1520)).scanDirection);
    upwards["compatible_settings"][4]["frame_readout_time"] = -8;
    EXPECT_THROW(read(upwards.dump()).makeCamera(cv::Size(1200, 1200)), rsackermann_samples::InputError);
    // Who measures the time doesn't need it.
    rsackermann_samples::CameraSettings measured = s;
    measured.needsReadOut = false;
    EXPECT_EQ(0, measured.makeCamera(cv::Size(1200, 1200)).lineDelay);
    nlohmann::json asymmetrical = nlohmann::json::parse(GYROFLOW_MODES);
    asymmetrical["asymmetrical"] = true;
    EXPECT_LT(cv::norm(read(asymmetrical.dump()).makeCamera(cv::Size(2704, 1520)).cameraMatrix -
                       cv::Matx33d(1200, 0, 1340, 0, 1210, 1000 - 254, 0, 0, 1)),
              1e-9);
}

// Of whatever size the images are, options go before what the profile says of them.
TEST(CameraFiles, options_for_a_profile_of_several_modes)
{
    const TemporaryFolder folder;
    writeContent(folder / "profile.json", GYROFLOW_MODES);
    const std::string file = "--camera=" + (folder / "profile.json");
    const char* const arguments[] = {"program", file.c_str(), "--scan=bottom_to_top", "--readout=0.02"};
    const rsackermann_samples::CameraSettings s = rsackermann_samples::readCameraOptions(
        rsackermann_samples::Options(4, arguments, rsackermann_samples::CAMERA_KEYS));
    for (const cv::Size& size : {cv::Size(2704, 2028), cv::Size(2704, 1520), cv::Size(1920, 1440)})
    {
        const cv::rsackermann::RollingShutterCamera camera = s.makeCamera(size);
        EXPECT_EQ(cv::rsackermann::SCAN_BOTTOM_TO_TOP, camera.scanDirection) << size;
        EXPECT_DOUBLE_EQ(0.02 / size.height, camera.lineDelay) << size;
    }
}

TEST(CameraFiles, modes_that_are_refused)
{
    const rsackermann_samples::CameraSettings s = read(GYROFLOW_MODES);
    const std::pair<cv::Size, const char*> cases[] = {
        {cv::Size(2560, 1200), "compatible_settings[3].digital_lens gopro_superview isn't known"},
        {cv::Size(1200, 1200), "several read-out times for images of 1200 x 1200 pixels, 0.009 and 0.008 s"},
        {cv::Size(600, 600), "several read-out times for images of 600 x 600"},
        {cv::Size(500, 900), "but the camera file is for 2704 x 2028"}};
    for (const auto& c : cases)
    {
        try
        {
            s.makeCamera(c.first);
            ADD_FAILURE() << c.second;
        }
        catch (const rsackermann_samples::InputError& e)
        {
            EXPECT_NE(std::string::npos, std::string(e.what()).find(c.second)) << e.what();
        }
    }
    // An option goes before all times of the file, also where the profile itself is one of several.
    nlohmann::json profile = nlohmann::json::parse(GYROFLOW_MODES);
    profile["compatible_settings"].push_back({{"frame_readout_time", 14}});
    const TemporaryFolder folder;
    writeContent(folder / "lens.json", profile.dump());
    const std::string camera = "--camera=" + (folder / "lens.json");
    for (const char* option : {"--readout=0.01", "--line_delay=0.00002"})
        for (const cv::Size& size : {cv::Size(1200, 1200), cv::Size(2704, 2028)})
        {
            const char* const arguments[] = {"program", camera.c_str(), option};
            const rsackermann_samples::Options options(3, arguments, rsackermann_samples::CAMERA_KEYS);
            const rsackermann_samples::CameraSettings given = rsackermann_samples::readCameraOptions(options);
            EXPECT_NEAR(option[2] == 'r' ? 0.01 / size.height : 0.00002, given.makeCamera(size).lineDelay, 1e-12);
        }
}

// Each message names the file and the field.
TEST(CameraFiles, lens_profiles_that_are_refused)
{
    typedef nlohmann::json Json;
    std::string overflow = GYROFLOW, notANumber = GYROFLOW;
    overflow.replace(overflow.find("19.0"), 4, "1e999");
    notANumber.replace(notANumber.find("750"), 3, "NaN");
    const std::pair<std::string, std::string> cases[] = {
        {profileWith("/distortion_model", "poly5"), "distortion_model poly5 isn't known"},
        {profileWith("/distortion_model", 5), "distortion_model 5 isn't known, only opencv_fisheye"},
        {profileWith("/digital_lens", "gopro_superview"), "digital_lens gopro_superview isn't known"},
        {profileWith("/global_shutter", true), "global_shutter"},
        {profileWith("/global_shutter", 1), "global_shutter is neither true nor false"},
        {profileWith("/fisheye_params", nullptr), "fisheye_params is missing"},
        {profileWith("/fisheye_params", 7), "fisheye_params is not an object"},
        {profileWith("/fisheye_params/camera_matrix", nullptr), "fisheye_params.camera_matrix is missing"},
        {profileWith("/fisheye_params/camera_matrix", Json::array()), "fisheye_params.camera_matrix hasn't 3 rows"},
        {profileWith("/fisheye_params/camera_matrix/1", {0, 500}), "fisheye_params.camera_matrix, row 2"},
        {profileWith("/fisheye_params/camera_matrix/0/0", "a"), "fisheye_params.camera_matrix, row 1: \"a\""},
        {profileWith("/fisheye_params/camera_matrix/0/0", -5), "focal length isn't above 0"},
        {profileWith("/fisheye_params/distortion_coeffs", nullptr), "fisheye_params.distortion_coeffs is missing"},
        {profileWith("/fisheye_params/distortion_coeffs", Json::array()), "has 0 numbers; 4 are expected"},
        {profileWith("/fisheye_params/distortion_coeffs/2", "x"), "fisheye_params.distortion_coeffs: \"x\""},
        {profileWith("/calib_dimension", nullptr), "calib_dimension is missing"},
        {profileWith("/calib_dimension/w", nullptr), "calib_dimension.w is missing"},
        {profileWith("/calib_dimension/h", 0), "calib_dimension.h: 0 is none of an image"},
        {profileWith("/calib_dimension/h", 380.5), "calib_dimension.h: 380.5 is none of an image"},
        {profileWith("/frame_readout_time", "long"), "frame_readout_time: \"long\" is not a number"},
        {profileWith("/frame_readout_time", 1e6), "frame_readout_time: 1e+06 is not from"},
        {profileWith("/frame_readout_direction", "Sideways"), "frame_readout_direction"},
        {profileWith("/frame_readout_direction", 1), "frame_readout_direction: '1' is none of TopToBottom"},
        {profileWith("/input_horizontal_stretch", 1000), "input_horizontal_stretch: 1000 is none of a lens"},
        {profileWith("/input_vertical_stretch", {1}), "input_vertical_stretch: [1] is not a number"},
        {profileWith("/crop", 0), "crop: 0 is not above 0"},
        {profileWith("/asymmetrical", "yes"), "asymmetrical is neither true nor false"},
        {profileWith("/compatible_settings", 7), "compatible_settings is not a list"},
        {profileWith("/compatible_settings", {7}), "compatible_settings[0] is not an object"},
        {profileWith("/compatible_settings", {{{"width", 640}}}), "compatible_settings[0].height is missing"},
        {profileWith("/compatible_settings", {{{"crop", 0}}}), "compatible_settings[0].crop: 0 is not above 0"},
        {profileWith("/compatible_settings", {{{"crop", 1e-200}}}), "camera.cameraMatrix"},
        {profileWith("/compatible_settings", {{{"frame_readout_time", 1e6}}}),
         "compatible_settings[0].frame_readout_time: 1e+06 is not from"},
        {"{\"crop\": 1, " + std::string(GYROFLOW).substr(1), "crop is there twice"},
        {overflow, "frame_readout_time: "},
        {notANumber, "camera_matrix: "},
        {std::string(GYROFLOW).substr(0, 300), "asymmetrical: "}};
    const TemporaryFolder folder;
    for (const std::pair<std::string, std::string>& refused : cases)
    {
        writeContent(folder / "lens.json", refused.first);
        rsackermann_samples::CameraSettings settings;
        try
        {
            rsackermann_samples::readCameraFile(folder / "lens.json", settings);
            ADD_FAILURE() << refused.first;
        }
        catch (const rsackermann_samples::UsageError& e)
        {
            const std::string message = e.what();
            EXPECT_EQ(0u, message.find("camera file " + (folder / "lens.json") + ": ")) << message;
            EXPECT_NE(std::string::npos, message.find(refused.second)) << message << "\n" << refused.second;
        }
    }
}

// The corrected image of a profile's camera is that of the same camera in OpenCV's format; --readout goes before it.
TEST(CameraFiles, lens_profile_of_a_program)
{
    const TemporaryFolder folder;
    nlohmann::json profile = nlohmann::json::parse(GYROFLOW);
    profile["calib_dimension"] = {{"w", 1920}, {"h", 1140}};
    profile["fisheye_params"]["camera_matrix"] = {{2448, 0, 960}, {0, 2448, 570}, {0, 0, 1}};
    profile["input_horizontal_stretch"] = 1;
    profile["frame_readout_time"] = -40;
    writeContent(folder / "lens.json", profile.dump());
    profile["calib_dimension"] = {{"w", 1920}, {"h", 1440}};
    profile["compatible_settings"] = {{{"width", 1920}, {"height", 1140}}};
    writeContent(folder / "modes.json", profile.dump());
    writeContent(folder / "camera.yml", "width: 640\nheight: 380\ndistortion_model: equidistant\n"
                                        "D: [0.25, -0.08, 0.22, -0.11]\n"
                                        "K: [816, 0, 319.5, 0, 816, 189.5, 0, 0, 1]\n"
                                        "scan: bottom_to_top\nreadout: 0.04\n");
    const std::string image = streetFolder() + "/rolling.png";
    for (const char* readOut : {"", "--readout=0.02"})
    {
        const char* const files[] = {"camera.yml", "lens.json", "modes.json"};
        nlohmann::json lines[3];
        for (int k = 0; k < 3; k++)
        {
            Arguments arguments = {image, "--camera=" + (folder / files[k]), "--report=-"};
            if (*readOut)
                arguments.push_back(readOut);
            const Outcome outcome = correct(arguments);
            ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
            lines[k] = nlohmann::json::parse(outcome.output);
        }
        EXPECT_EQ("ok", lines[0]["status"]);
        for (const char* key : {"yaw_rate_deg_s", "speed_km_h"})
            for (const nlohmann::json& line : lines)
                EXPECT_NEAR(lines[0][key].is_null() ? 0 : lines[0][key].get<double>(),
                            line[key].is_null() ? 0 : line[key].get<double>(), 1e-3);
    }
}

TEST(CameraFiles, options_go_before_the_file)
{
    const Outcome file = correct({streetFolder() + "/rolling.png", "--camera=" + streetFolder() + "/camera.yml",
                                  "--gravity_sigma=0", "--report=-"});
    const Outcome option = correct({streetFolder() + "/rolling.png", "--camera=" + streetFolder() + "/camera.yml",
                                    "--gravity_sigma=0", "--report=-", "--readout=0.0266666666666"});
    const nlohmann::json a = nlohmann::json::parse(file.output), b = nlohmann::json::parse(option.output);
    EXPECT_NEAR(a["yaw_rate_deg_s"].get<double>() / 2, b["yaw_rate_deg_s"].get<double>(), 3);
}

TEST(CameraFiles, for_another_size)
{
    const TemporaryFolder folder;
    cv::imwrite(folder / "small.png", cv::Mat::zeros(100, 100, CV_8U));
    const Outcome outcome = correct({folder / "small.png", "--camera=" + streetFolder() + "/camera.yml", "--report=-"});
    EXPECT_EQ(1, outcome.exitCode);
    EXPECT_NE(std::string::npos, outcome.messages.find("640 x 380")) << outcome.messages;
}

}} // namespace
