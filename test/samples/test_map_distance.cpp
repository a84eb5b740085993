// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "program.hpp"
#include "map_distance.hpp"
#include "truth_file.hpp"

#include "opencv2/rsackermann.hpp"

namespace opencv_test { namespace {

using rsackermann_samples::meanDistance;

const float NONE = -16384; // both coordinates of a pixel without a place

// A row of a map or of a mask.
cv::Mat map(const std::vector<float>& values)
{
    return cv::Mat(values, true).reshape(1, 1);
}
cv::Mat mask(const std::vector<uchar>& values)
{
    return cv::Mat(values, true).reshape(1, 1);
}

TEST(MapDistance, is_the_mean_of_the_pixels_of_the_mask)
{
    const cv::Mat x1 = map({0, 1, 2, 3}), y1 = map({0, 0, 0, 0}), x2 = map({3, 1, 2, 103}), y2 = map({4, 0, 1, 0});
    EXPECT_NEAR((5 + 0 + 1 + 100) / 4., meanDistance(x1, y1, x2, y2, mask({255, 255, 255, 255})), 1e-6);
    EXPECT_NEAR((5 + 0 + 1) / 3., meanDistance(x1, y1, x2, y2, mask({255, 255, 255, 0})), 1e-6);
    EXPECT_EQ(0, meanDistance(x1, y1, x2, y2, mask({0, 0, 0, 0})));
}

TEST(MapDistance, pixels_without_a_place_do_not_count)
{
    const cv::Mat x1 = map({0, NONE, 2, NONE}), y1 = map({0, NONE, 0, NONE}), x2 = map({3, 1, NONE, NONE}),
                  y2 = map({4, 0, NONE, NONE});
    EXPECT_NEAR(5, meanDistance(x1, y1, x2, y2, mask({255, 255, 255, 255})), 1e-6);
    EXPECT_NEAR(5, meanDistance(x2, y2, x1, y1, mask({255, 255, 255, 255})), 1e-6);
    EXPECT_EQ(0, meanDistance(x1, y1, x2, y2, mask({0, 255, 255, 255})));
}

// A place is none only if both coordinates say so.
TEST(MapDistance, places)
{
    const cv::Mat places = rsackermann_samples::placesOf(map({0, NONE, NONE, -20000}), map({0, 5, NONE, 3}));
    EXPECT_EQ(0, cv::norm(places, mask({255, 255, 0, 255}), cv::NORM_INF));
}

// Through this lens nothing is seen beyond 44 degrees: pixels near the border have no place, with a motion others than
// without.
TEST(Correct, mean_shift_with_a_strong_lens)
{
    const TemporaryFolder folder;
    const std::string street = folder / "street";
    ASSERT_EQ(
        0,
        simulate({"--output=" + street, "--lens=-0.36,0,0,0", "--focal=300", "--speed=60", "--yaw_rate=40"}).exitCode);
    const Outcome outcome = correct({street + "/rolling.png", "--camera=" + street + "/camera.yml", "--wall=2.5",
                                     "--yaw_rate=40", "--report=-", "--maps=" + (folder / "maps.yml")});
    ASSERT_EQ(0, outcome.exitCode) << outcome.messages;
    const nlohmann::json report = nlohmann::json::parse(outcome.output);
    ASSERT_EQ("ok", report["status"]);
    cv::Mat map1, map2, lens1, lens2;
    cv::FileStorage fs(folder / "maps.yml", cv::FileStorage::READ);
    fs["map1"] >> map1;
    fs["map2"] >> map2;
    const cv::Matx33d K(300, 0, 319.5, 0, 300, 189.5, 0, 0, 1);
    const cv::rsackermann::RollingShutterCamera camera(cv::Size(640, 380), K, {-0.36, 0, 0, 0});
    cv::rsackermann::WarpMapGenerator::create(camera)->initRectifyMap(cv::rsackermann::AckermannMotion(), lens1, lens2);
    double sum = 0;
    int compared = 0, missing = 0;
    for (int y = 0; y < map1.rows; y++)
        for (int x = 0; x < map1.cols; x++)
        {
            const cv::Point2f p(map1.at<float>(y, x), map2.at<float>(y, x)),
                q(lens1.at<float>(y, x), lens2.at<float>(y, x));
            if (p.x < 0 || p.y < 0 || p.x > 639 || p.y > 379)
                continue;
            if (q.x == NONE)
                missing++;
            else
            {
                sum += cv::norm(p - q);
                compared++;
            }
        }
    ASSERT_GT(missing, 0);
    EXPECT_NEAR(sum / compared, report["mean_shift_px"].get<double>(), 0.01);
    EXPECT_GT(report["mean_shift_px"].get<double>(), 0.5);
    EXPECT_LT(report["mean_shift_px"].get<double>(), 5);
}

class EvaluateMaps : public testing::Test
{
public:
    EvaluateMaps()
    {
        const rsackermann_samples::Truth truth = rsackermann_samples::readTruth(streetFolder() + "/truth.json");
        street::StreetRenderer(truth.camera, truth.scene).rectifyMap(columns, rows, seen);
        rsackermann_samples::identityMaps(truth.camera.size, identityColumns, identityRows);
        // each place 1.5 pixels to the right of the true one and 2 below it
        columns += 1.5;
        rows += 2;
    }

    void writeMaps(const std::string& path) const
    {
        cv::FileStorage fs(path, cv::FileStorage::WRITE);
        fs << "map1" << columns << "map2" << rows;
    }

    // The last lines of the evaluation.
    std::string evaluation()
    {
        const TemporaryFolder folder;
        writeContent(folder / "report.jsonl", "{}\n");
        writeMaps(folder / "maps.yml");
        const Outcome outcome = evaluate({"--truth=" + streetFolder() + "/truth.json",
                                          "--report=" + (folder / "report.jsonl"), "--maps=" + (folder / "maps.yml")});
        EXPECT_EQ(0, outcome.exitCode) << outcome.messages;
        const size_t at = outcome.output.find("mean displacement, px");
        return at == std::string::npos ? outcome.output : outcome.output.substr(at);
    }

    void expectDisplacements(double before, double after)
    {
        double gotBefore = -1, gotAfter = -1;
        const std::string output = evaluation();
        EXPECT_EQ(2, std::sscanf(output.c_str(), "mean displacement, px %lf %lf", &gotBefore, &gotAfter)) << output;
        EXPECT_NEAR(before, gotBefore, 2e-3);
        EXPECT_NEAR(after, gotAfter, 2e-3);
    }

    cv::Mat columns, rows, seen, identityColumns, identityRows;
};

TEST_F(EvaluateMaps, every_pixel_has_a_place)
{
    const double before = meanDistance(identityColumns, identityRows, columns - 1.5, rows - 2, seen);
    EXPECT_GT(before, 2);
    expectDisplacements(before, 2.5);
    EXPECT_EQ(std::string::npos, evaluation().find("no place"));
}

TEST_F(EvaluateMaps, pixels_without_a_place_count_neither_before_nor_after)
{
    const cv::Rect gone(0, 0, 200, 380), left(200, 0, 440, 380);
    columns(gone) = NONE;
    rows(gone) = NONE;
    expectDisplacements(
        meanDistance(identityColumns(left), identityRows(left), columns(left) - 1.5, rows(left) - 2, seen(left)), 2.5);
    const int all = cv::countNonZero(seen), lost = cv::countNonZero(seen(gone));
    EXPECT_NE(std::string::npos, evaluation().find(cv::format("%d of %d pixels have no place", lost, all)));
}

TEST_F(EvaluateMaps, no_pixel_has_a_place)
{
    columns = NONE;
    rows = NONE;
    const std::string output = evaluation();
    char before = 0, after = 0;
    EXPECT_EQ(2, std::sscanf(output.c_str(), "mean displacement, px %c %c", &before, &after)) << output;
    EXPECT_EQ('-', before);
    EXPECT_EQ('-', after);
}

// Whatever is in the files, the message names the one that is wrong.
TEST_F(EvaluateMaps, files_that_hold_something_else)
{
    const TemporaryFolder folder;
    writeMaps(folder / "good.yml");
    const auto expectRefused = [&](const std::string& maps, const std::string& report, const std::string& culprit) {
        writeContent(folder / "report.jsonl", report);
        const Outcome outcome = evaluate({"--truth=" + streetFolder() + "/truth.json",
                                          "--report=" + (folder / "report.jsonl"), "--maps=" + (folder / maps)});
        EXPECT_EQ(1, outcome.exitCode) << outcome.messages;
        EXPECT_NE(std::string::npos, outcome.messages.find(folder / culprit)) << outcome.messages;
        EXPECT_EQ(std::string::npos, outcome.messages.find("json.exception")) << outcome.messages;
    };
    const auto matrix = [](const std::string& data) {
        return "map1: !!opencv-matrix\n   rows: 380\n   cols: 640\n   dt: f\n   data: " + data + "\n";
    };
    std::string nested = "[ [ 1. ]", words = "[ a";
    for (int i = 1; i < 380 * 640; i++)
    {
        nested += i % 8 ? ", [ 1. ]" : ",\n      [ 1. ]";
        words += i % 8 ? ", a" : ",\n      a";
    }
    for (const std::string& content :
         {std::string("map1:\n   a:\n      b: 1\n"), std::string("map1: [ 1, 2 ]\n"), matrix("[ 1., 2. ]"), matrix("3"),
          matrix("{ a: 1 }"), matrix("!!binary |\n      MWYg"), matrix(nested + " ]"), matrix(words + " ]"),
          std::string("- 1\n"), "a: " + std::string(100000, '[')})
    {
        writeContent(folder / "bad.yml", "%YAML:1.0\n---\n" + content);
        expectRefused("bad.yml", "{}\n", "bad.yml");
    }
    for (const std::string& content :
         {std::string("hello"), std::string("[1]"), std::string("{\"map1\": {\"a\": {\"b\": 1}}}"),
          std::string("<?xml version=\"1.0\"?>\n<opencv_storage><map1><a>1</a></map1></opencv_storage>\n")})
    {
        writeContent(folder / "bad", content);
        expectRefused("bad", "{}\n", "bad");
    }
    for (const char* line : {"{\"width\": 641, \"height\": 380}", "{\"width\": \"640\"}", "{\"status\": 1}"})
        expectRefused("good.yml", line, "report.jsonl");
}

}} // namespace
