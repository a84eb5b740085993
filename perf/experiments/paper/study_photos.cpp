// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "contestants.hpp"
#include "photo_sets.hpp"
#include "study.hpp"

#include "opencv2/core/utils/filesystem.hpp"
#include "opencv2/imgcodecs.hpp"
#include "opencv2/imgproc.hpp"

namespace paper {

using namespace cv::rsackermann;

namespace {

const double PRIOR_WALL = 8; // metres, for the paper's method if the wall's distance is unknown

// An image, made small, under its caption.
cv::Mat tile(const cv::Mat& image, const std::string& caption)
{
    const int width = 360, margin = 22;
    cv::Mat small, result;
    cv::resize(image, small, cv::Size(width, cvRound(image.rows * width / double(image.cols))), 0, 0, cv::INTER_AREA);
    cv::copyMakeBorder(small, result, margin, 0, 2, 2, cv::BORDER_CONSTANT, cv::Scalar::all(255));
    cv::putText(result, caption, cv::Point(4, 16), cv::FONT_HERSHEY_SIMPLEX, 0.45, cv::Scalar::all(0), 1, cv::LINE_AA);
    return result;
}

} // namespace

// Images of a folder, with strips of the raw and the corrected ones.
void studyPhotos(const StudyOptions& options)
{
    const std::vector<PhotoSet> sets = findPhotoSets(options.photos);
    std::vector<std::pair<int, int>> cases; // number of the set and in the set
    for (size_t s = 0; s < sets.size(); s++)
        for (int i = 0; i < (options.quick ? 1 : sets[s].size); i++)
            cases.push_back(std::make_pair(int(s), i));
    const std::string strips = options.folder + "/strips";
    cv::utils::fs::createDirectories(strips);
    const auto make = [&](int k, std::vector<std::vector<Row>>& tables) {
        const PhotoSet& set = sets[cases[k].first];
        const PhotoCase c = set.at(cases[k].second);
        Problem problem = {c.camera, cv::Mat(), c.wallDistance, MotionPrior(), options.seed + k};
        detectSegments(c.image, problem.segments, DETECTOR);
        std::vector<cv::Mat> tiles(1, tile(c.image, "raw"));
        for (const Contestant& contestant : mainContestants())
        {
            Problem own = problem;
            if (contestant.name == "paper" && own.wallDistance == 0)
                own.wallDistance = PRIOR_WALL;
            const AckermannMotion motion = contestant.estimate(own).motion;
            cv::Mat columns, rows, corrected;
            WarpMapGenerator::create(c.camera)->initRectifyMap(motion, columns, rows);
            cv::remap(c.image, corrected, columns, rows, cv::INTER_LINEAR);
            tiles.push_back(tile(corrected, contestant.name));
            double before = 0, after = 0;
            c.measure(columns, rows, before, after);
            const std::string folder = set.folder.substr(set.folder.find_last_of('/') + 1);
            tables[0].push_back({contestant.name, set.kind, folder, c.name, set.measure, number(before), number(after),
                                 std::to_string(motion.status)});
        }
        if (!c.global.empty())
            tiles.push_back(tile(c.global, "global shutter"));
        cv::Mat strip;
        cv::hconcat(tiles, strip);
        cv::imwrite(strips + cv::format("/%s_%02d_%02d.jpg", set.kind.c_str(), cases[k].first, cases[k].second), strip);
    };
    writeTable(options.folder + "/photos.csv", "contestant,kind,folder,image,measure,before,after,status",
               makeRows("photos", int(cases.size()), 1, make)[0]);
}

} // namespace paper
