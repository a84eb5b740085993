// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Each option changes the result in each mode, or is refused, or the user is told that it does nothing.

#include "program.hpp"

#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace opencv_test { namespace {

typedef nlohmann::ordered_json Json;

enum Effect {
    CHANGES,
    REFUSED,
    WARNED,     // with "no effect"
    DOCUMENTED, // in the help
    NONE        // says where results go, not what they are
};

struct Flip
{
    std::string name, value;
    Arguments before; // of the run to compare with, and of that with the option
    Effect alone, inSequence;
};

//! The names of options that --help prints.
std::set<std::string> optionsOf(const std::string& program, std::string& help)
{
    help = runProgram(program, {"--help"}).output;
    std::set<std::string> names;
    const std::regex name("\\n\\t(-[^\\n]*, )?--([a-z_]+)");
    for (std::sregex_iterator it(help.begin(), help.end(), name); it != std::sregex_iterator(); ++it)
        names.insert((*it)[2]);
    return names;
}

//! The paragraph of the help on an option.
std::string helpOn(const std::string& name, const std::string& help)
{
    const size_t begin = help.find("--" + name), end = help.find("\n\t-", begin);
    return help.substr(begin, end - begin);
}

class OptionEffects : public testing::Test
{
protected:
    OptionEffects()
    {
        simulate({"--output=" + (folder / "drive"), "--frames=3", "--speed=60", "--left=5", "--right=6", "--depth"});
        std::vector<cv::String> depths;
        cv::glob(folder / "drive/depth/*.png", depths);
        for (const cv::String& name : depths) // of 1/256 m
        {
            cv::Mat millimetres;
            cv::imread(name, cv::IMREAD_UNCHANGED).convertTo(millimetres, CV_16U, 1000. / 256);
            cv::imwrite(name, millimetres);
        }
        std::string lines;
        for (int x = 50; x < 600; x += 11)
            lines += cv::format("%d 100 %d 200\n", x, x + x % 7);
        writeContent(folder / "lines.txt", lines);
        image = folder / "drive/frames/000002.png";
    }

    //! What the result says, without times and what was given; empty if the command is refused.
    std::string resultOf(const Arguments& arguments, std::string& messages) const
    {
        const Outcome outcome = correct(arguments + Arguments{"--report=-"});
        messages = outcome.messages;
        std::string result;
        std::istringstream stream(outcome.exitCode == 0 ? outcome.output : "");
        for (std::string line; std::getline(stream, line);)
        {
            Json json = Json::parse(line);
            for (Json::iterator it = json.begin(); it != json.end(); ++it)
                if (it.key().find("ms_") != 0 && it.key().find("given_") != 0 && it.key() != "time_s" &&
                    it.key() != "depth_used")
                    result += it.key() + it.value().dump() + "\n";
        }
        return result;
    }

    void check(const Flip& flip, const Arguments& base, Effect effect, const std::string& help)
    {
        if (effect == NONE)
            return;
        SCOPED_TRACE(flip.name);
        const std::string option = "--" + flip.name + (flip.value.empty() ? "" : "=") + flip.value;
        std::string messages;
        std::string& before = before_[base + flip.before];
        if (before.empty())
            before = resultOf(base + flip.before, messages);
        ASSERT_NE("", before) << messages;
        const std::string after = resultOf(base + flip.before + Arguments{option}, messages);
        EXPECT_EQ(effect == REFUSED, after.empty()) << messages;
        EXPECT_EQ(effect == WARNED || effect == DOCUMENTED, before == after) << messages;
        EXPECT_EQ(effect == WARNED, messages.find("no effect") != std::string::npos) << messages;
        if (effect == DOCUMENTED)
        {
            EXPECT_TRUE(
                std::regex_search(helpOn(flip.name, help), std::regex("no effect|without|number of threads|if none")))
                << helpOn(flip.name, help);
        }
    }

    const TemporaryFolder folder;
    std::string image;

private:
    std::map<Arguments, std::string> before_; //!< results without the option
};

const int PARTS = 4;

//! Parameters: whether it is a sequence, and which part of the table.
class EachOptionEffects : public OptionEffects, public testing::WithParamInterface<std::tuple<bool, int>>
{
};

TEST_P(EachOptionEffects, of_rsackermann_correct)
{
    const std::string drive = folder / "drive/";
    const Arguments focal = {"--focal=816"}, none, delay = {"--focal=816", "--readout=0.0133"},
                    given = delay + Arguments{"--speed=40", "--yaw_rate=3"}, wall = delay + Arguments{"--wall=6"},
                    gyro = delay + Arguments{"--gyro=" + drive + "gyro.csv"},
                    depth = delay + Arguments{"--speed=60", "--depth=" + drive + "depth/"};
    const Flip flips[] = {
        {"camera", (drive + "camera.yml"), {"--pitch=1"}, CHANGES, CHANGES},
        {"focal", "700", {"--readout=0.0133"}, CHANGES, CHANGES},
        {"focal_sigma", "60", delay, CHANGES, CHANGES},
        {"line_delay", "4e-5", focal, CHANGES, CHANGES},
        {"readout", "0.02", focal, CHANGES, CHANGES},
        {"scan", "bottom_to_top", delay, CHANGES, CHANGES},
        {"reference", "first", delay, CHANGES, CHANGES},
        {"roll", "1", delay, CHANGES, CHANGES},
        {"pitch", "2", delay, CHANGES, CHANGES},
        {"gravity_sigma", "2", delay, CHANGES, CHANGES},
        {"usual_yaw_rate", "30", delay, CHANGES, CHANGES},
        {"heading", "3", delay, CHANGES, CHANGES},
        {"height", "1.6", delay, CHANGES, CHANGES},
        {"wall", "4", delay, CHANGES, CHANGES},
        {"scale_from_road", "", delay + Arguments{"--height=1.2"}, CHANGES, CHANGES},
        {"scale_from_road", "", delay, WARNED, WARNED},
        {"scale_from_road", "", wall, REFUSED, REFUSED},
        {"speed", "50", delay, CHANGES, CHANGES},
        {"speed", "50", focal, WARNED, WARNED},
        {"speed", "50", delay + Arguments{"--scan=left_to_right"}, WARNED, WARNED},
        {"speed_sigma", "9", given, CHANGES, CHANGES},
        {"speed_sigma", "9", delay, REFUSED, REFUSED},
        {"yaw_rate", "8", delay, CHANGES, CHANGES},
        {"yaw_rate", "8", focal, WARNED, WARNED},
        {"yaw_rate_sigma", "7", given, CHANGES, CHANGES},
        {"yaw_rate_sigma", "7", delay, REFUSED, REFUSED},
        {"log", (folder / "values.csv"), delay, CHANGES, CHANGES},
        {"log", (folder / "values.csv"), focal, WARNED, WARNED},
        {"gyro", (drive + "gyro.csv"), delay, WARNED, CHANGES}, // a single image needs its time
        {"gyro", (drive + "gyro.csv"), focal, WARNED, WARNED},
        {"gyro_delay", "0.02", gyro + Arguments{"--log=" + drive + "log.csv"}, CHANGES, CHANGES},
        {"gyro_delay", "0.3", delay, REFUSED, REFUSED},
        {"depth", (drive + "depth/"), delay + Arguments{"--speed=60"}, CHANGES, CHANGES},
        {"depth", (drive + "depth/"), delay, WARNED, WARNED},
        {"depth_kind", "relative", depth, CHANGES, CHANGES},
        {"depth_kind", "relative", delay, REFUSED, REFUSED},
        {"depth_camera", "corrected", depth, CHANGES, NONE}, // these are the raw camera's, and points contradict them
        {"depth_camera", "corrected", delay, REFUSED, REFUSED},
        {"depth_scale", "0.00102", depth, CHANGES, CHANGES},
        {"depth_scale", "0.002", delay, REFUSED, REFUSED},
        {"depth_scale_sigma", "0.2", depth, CHANGES, CHANGES},
        {"depth_scale_sigma", "0.03", delay, REFUSED, REFUSED},
        {"depth_scale_sigma", "0.2", depth + Arguments{"--depth_camera=corrected"}, CHANGES, NONE},
        {"depth_scale_sigma", "0.03", depth + Arguments{"--depth_kind=relative"}, REFUSED, REFUSED},
        {"baseline", "0.3", depth, REFUSED, REFUSED},
        {"baseline", "0.5", depth + Arguments{"--depth_kind=disparity", "--baseline=0.3"}, REFUSED, REFUSED}, // twice
        {"model", "none", delay, CHANGES, REFUSED},
        {"detector", "lsd", delay, CHANGES, CHANGES},
        {"detector", "lsd", delay + Arguments{"--lines=" + (folder / "lines.txt")}, REFUSED, NONE},
        {"lines", (folder / "lines.txt"), delay, CHANGES, REFUSED},
        {"seed", "10", delay + Arguments{"--gravity_sigma=0"}, CHANGES, NONE},
        {"seed", "5", delay, NONE, DOCUMENTED},
        {"threads", "1", delay, DOCUMENTED, DOCUMENTED},
        {"smooth", "", delay, NONE, NONE}, // the modes themselves
        {"carry", "", delay, NONE, NONE},
        {"carry", "", focal, WARNED, REFUSED},
        {"output", "", none, NONE, NONE},
        {"overlay", "", none, NONE, NONE},
        {"report", "", none, NONE, NONE},
        {"maps", "", none, NONE, NONE},
        {"shard", "", none, NONE, NONE},
        {"skip_existing", "", none, NONE, NONE},
        {"overwrite", "", none, NONE, NONE},
        {"help", "", none, NONE, NONE}};
    writeContent(folder / "values.csv", "frame,time_s,speed_kmh\n0,10,30\n1,10.04,33\n2,10.08,35\n");
    std::string help;
    std::set<std::string> unknown = optionsOf(CORRECT_PROGRAM, help);
    EXPECT_GT(unknown.size(), 40u);
    const bool isSequence = std::get<0>(GetParam());
    int number = 0;
    for (const Flip& flip : flips)
    {
        unknown.erase(flip.name);
        if (number++ % PARTS != std::get<1>(GetParam()))
            continue;
        if (isSequence)
            check(flip, {folder / "drive/frames", "--carry"}, flip.inSequence, help);
        else
            check(flip, {image}, flip.alone, help);
    }
    for (const std::string& name : unknown)
        ADD_FAILURE() << "what --" << name << " does in each mode isn't tested";
}

TEST_F(OptionEffects, of_the_modes)
{
    std::string messages;
    std::set<std::string> results;
    for (const Arguments& mode : {Arguments{}, Arguments{"--carry"}, Arguments{"--smooth"}})
        results.insert(
            resultOf(Arguments{folder / "drive/frames", "--focal=816", "--readout=0.0133"} + mode, messages));
    EXPECT_EQ(3u, results.size());
}

INSTANTIATE_TEST_CASE_P(Modes, EachOptionEffects, testing::Combine(testing::Bool(), testing::Range(0, PARTS)));

}} // namespace opencv_test::
