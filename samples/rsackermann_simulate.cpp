// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Makes rolling-shutter images with known truth: renders a street, or distorts a given global-shutter image of one.

#include "camera_file.hpp"
#include "files.hpp"
#include "output/atomic_file.hpp"
#include "output/output_plan.hpp"
#include "output/result_names.hpp"
#include "progress.hpp"
#include "simulate/depth_image.hpp"
#include "simulate/drive_files.hpp"
#include "street_model.hpp"
#include "truth_file.hpp"
#include "units.hpp"

#include "opencv2/imgproc.hpp"

namespace {

using namespace rsackermann_samples;

const char* const ABOUT =
    "Makes a rolling-shutter image with known truth: renders a street, or distorts a global-shutter image of one.\n"
    "Writes rolling.png, global.png (the view of a global shutter, without a lens), truth.json and camera.yml (for\n"
    "rsackermann_correct --camera) to a folder; with --depth also rolling_depth.png and global_depth.png (16 bits,\n"
    "1/256 m along the optical axis, 0 for the sky and beyond 255 m). With --frames it renders a drive instead:\n"
    "frames/NNNNNN.png, log.csv with their times, gyro.csv (for rsackermann_correct --gyro), truth.jsonl and camera.yml;\n"
    "with --depth also depth/NNNNNN.png, of the frames, and with --global global/NNNNNN.png.\n"
    "Exit code: 0 done, 1 failed, 2 the command line isn't understood.\n";

const char* const KEYS =
    "{help       |         | print this message}"
    "{output     |         | folder for the results, made if missing}"
    "{overwrite  |         | replace existing files}"
    "{image      |         | global-shutter image to be distorted instead of a rendered street}"
    "{size       | 640x380 | of a rendered image, pixels}"
    "{focal      |         | focal length, pixels (default 816; with --image 0.9 times the longer side)}"
    "{lens       |         | 4, 5 or 8 coefficients of cv::projectPoints, with commas between}"
    "{line_delay |         | seconds between two lines}"
    "{readout    |         | seconds between the first and the last line's end (default 0.013333), instead of "
    "--line_delay}"
    "{scan       | top_to_bottom | order of the lines: top_to_bottom, bottom_to_top, left_to_right or right_to_left}"
    "{reference  | middle  | line at whose instant the global-shutter image is taken: first, middle, last or its "
    "number}"
    "{roll       | 0       | degrees, positive if the camera is turned clockwise seen from behind it}"
    "{pitch      | 0       | degrees, positive if the camera looks down}"
    "{heading    | 0       | degrees from the optical axis to the vehicle's forward direction, positive to the right}"
    "{height     | 1.2     | metres of the camera above the road}"
    "{speed      | 60      | km/h, negative in reverse}"
    "{yaw_rate   |         | deg/s, positive if the car turns to the right (default 40); of a drive the greatest one "
    "(default 10)}"
    "{left       | 2.5     | metres to the left wall, 0: there is none}"
    "{right      | 3       | metres to the right wall, 0: there is none}"
    "{wall_direction |     | degrees from the optical axis to the direction along the walls (default: the heading)}"
    "{clutter    | 0       | share of slanted lines in the rendered street, 0..1}"
    "{stagger    | 0       | metres: each rendered house stands back from its wall by its own amount between 0 and "
    "this}"
    "{obstacles  | 0       | parked cars, posts and leaning trees on 100 m of each side of the rendered street; cars "
    "park only if the camera passes the wall at 2.8 m or more}"
    "{stains     | 0       | contrast of stains on all of the rendered street, 0..1}"
    "{frames     |         | render a drive of so many frames, 30 a second, instead of one image: the car weaves, to and "
    "fro in 4 s}"
    "{speed_swing | 0      | km/h by which a drive is faster than --speed at first, and slower after 2 s: to and fro in "
    "4 s}"
    "{global     |         | of a drive: write the view of a global shutter of each frame, too}"
    "{shake      | none    | what shakes the camera: none, suspension (pitch and roll about 1.4 Hz), engine (20 to 40 "
    "Hz) or phone (an arm at 7 Hz)}"
    "{shake_rate |         | deg/s, root mean square of the pitch rate of shaking (default: 1.5, 5 or 11)}"
    "{gyro_rate  | 200     | of the gyro on the camera of a drive, samples per second}"
    "{gyro_noise | 0.1     | deg/s, standard deviation of a sample}"
    "{gyro_bias  | 0       | deg/s that it shows too much about each axis}"
    "{gyro_delay | 0       | seconds by which its clock is ahead}"
    "{depth      |         | write the true depth of both rendered images, or of a drive's frames, too}"
    "{noise      | 1       | of the rendered image, grey levels}"
    "{samples    | 3       | rays across and down a pixel}"
    "{rays       | grid    | of a pixel: on a grid, or staggered, each with an x and a y of its own, so that edges along "
    "rows and columns move as smoothly as others}"
    "{seed       | 0       | of the rendered street}"
    "{threads    |         | maximum number of threads}";

CameraSettings readSettings(const Options& options, const cv::Size& size, double defaultFocal)
{
    if (options.given("line_delay") && options.given("readout"))
        throw UsageError("--line_delay and --readout exclude each other");
    CameraSettings s;
    s.size = size;
    s.calibrated = true;
    const double focal = options.given("focal") ? options.positive("focal", MOST_FOCAL) : defaultFocal;
    s.K = cv::Matx33d(focal, 0, (size.width - 1) / 2., 0, focal, (size.height - 1) / 2., 0, 0, 1);
    if (options.given("lens"))
        s.lens = options.numbers("lens");
    if (!s.lens.empty() && s.lens.size() != 4 && s.lens.size() != 5 && s.lens.size() != 8)
        throw UsageError("option --lens: there are 4, 5 or 8 coefficients");
    s.scan = options.choice("scan", SCAN_WORDS);
    if (options.given("line_delay"))
        s.lineDelay = options.positive("line_delay", cv::rsackermann::LONGEST_READ_OUT);
    else
        s.readOut =
            options.given("readout") ? options.positive("readout", cv::rsackermann::LONGEST_READ_OUT) : 0.4 / 30;
    s.reference = readReference(options);
    s.roll = options.number("roll", -MOST_TILT, MOST_TILT);
    s.pitch = options.number("pitch", -MOST_TILT, MOST_TILT);
    s.rollIsGiven = s.pitchIsGiven = s.headingIsGiven = true;
    s.heading = options.number("heading", -MOST_HEADING, MOST_HEADING);
    s.height = options.positive("height", MOST_HEIGHT);
    return s;
}

Truth readTruthOptions(const Options& options, const CameraSettings& settings)
{
    const cv::rsackermann::RollingShutterCamera camera = settings.makeCamera(settings.size);
    Truth truth = {street::StreetCamera(settings.size, settings.K(0, 0), camera.lineDelay, settings.height),
                   street::StreetScene()};
    truth.camera.lens = settings.lens;
    truth.camera.scan = settings.scan;
    truth.camera.reference = camera.referenceRow;
    truth.camera.roll = settings.roll * DEGREE;
    truth.camera.pitch = settings.pitch * DEGREE;
    truth.camera.heading = settings.heading * DEGREE;

    street::StreetScene& scene = truth.scene;
    scene.speed = options.number("speed", -500, 500) * KMH;
    const double usualYawRate = options.given("frames") ? 10 : 40;
    scene.yawRate = (options.given("yaw_rate") ? options.number("yaw_rate", -360, 360) : usualYawRate) * DEGREE;
    scene.left = options.number("left", 0, 1000);
    scene.right = options.number("right", 0, 1000);
    scene.wallDirection =
        (options.given("wall_direction") ? options.number("wall_direction", -180, 180) : settings.heading) * DEGREE;
    scene.clutter = options.number("clutter", 0, 1);
    scene.stagger = options.number("stagger", 0, 10);
    scene.obstacles = options.number("obstacles", 0, 100);
    scene.stains = options.number("stains", 0, 1);
    scene.noise = options.number("noise", 0, 100);
    scene.seed = unsigned(options.integer("seed", 0, 1 << 30));
    const int shake = options.choice("shake", street::Shake::words());
    if (options.given("shake_rate") && shake == street::Shake::NONE)
        throw UsageError("--shake_rate needs --shake");
    const double shakeRate =
        options.given("shake_rate") ? options.number("shake_rate", 0, 1000) * DEGREE : street::Shake::usualRate(shake);
    truth.camera.shake = street::Shake(shake, shakeRate, scene.seed);
    return truth;
}

street::SimulatedGyro readGyroOptions(const Options& options, unsigned seed)
{
    street::SimulatedGyro gyro;
    gyro.rate = options.positive("gyro_rate", 1e5);
    gyro.noise = options.number("gyro_noise", 0, 100) * DEGREE;
    gyro.bias = cv::Vec3d::all(options.number("gyro_bias", -100, 100) * DEGREE);
    gyro.delay = options.number("gyro_delay", -1e6, 1e6);
    gyro.seed = seed;
    return gyro;
}

street::StreetRenderer::Rays raysOf(const Options& options)
{
    return street::StreetRenderer::Rays(options.choice("rays", {"grid", "staggered"}));
}

// The rolling-shutter image of a global-shutter one; parts that it doesn't show are mirrored, since a border would be
// an edge.
cv::Mat distort(const cv::Mat& image, const Truth& truth)
{
    using namespace cv::rsackermann;
    const AckermannMotion motion = libraryMotion(truth.camera, truth.scene);
    cv::Mat map1, map2, distorted;
    WarpMapGenerator::create(libraryCamera(truth.camera))->initDistortMap(motion, map1, map2);
    cv::remap(image, distorted, map1, map2, cv::INTER_CUBIC, cv::BORDER_REFLECT_101);
    return distorted;
}

void writeImage(AtomicFile& file, const cv::Mat& image)
{
    const std::vector<uchar> bytes = encodeImage(file.path(), image);
    file.write(bytes.data(), bytes.size());
}

// No result replaces an input, and none an existing file unless that is wanted.
void checkResults(const Options& options, const std::vector<std::string>& results)
{
    for (const std::string& path : results)
        checkResult(path, options.flag("overwrite"));
    OutputPlan plan;
    plan.addInputs(options.inputFiles());
    for (const std::string& path : results)
        plan.addOutput(path, path);
}

void writeDrive(const Options& options, const CameraSettings& settings, const Truth& truth)
{
    const DriveFiles files = {options.outputFile("output") + "/",
                              options.integer("frames", 1, 100000),
                              options.integer("samples", 1, 16),
                              settings,
                              readGyroOptions(options, truth.scene.seed),
                              options.flag("depth"),
                              options.flag("global"),
                              raysOf(options)};
    checkResults(options, files.names());
    const std::string doubt = doubtOfReadOut(libraryCamera(truth.camera), 1 / street::RenderedDrive::framesPerSecond());
    if (!doubt.empty())
        options.warn(doubt);
    street::RenderedDrive drive(truth.camera, truth.scene);
    drive.course = street::RenderedDrive::WEAVING;
    drive.speedSwing = options.number("speed_swing", -500, 500) * KMH;
    files.write(drive);
}

void checkTogether(const Options& options)
{
    if (options.given("image"))
        for (const char* name : {"size", "clutter", "stagger", "obstacles", "stains", "depth", "noise", "samples",
                                 "rays", "seed", "frames", "shake", "shake_rate"})
            if (options.given(name))
                throw UsageError(std::string("--") + name + " is for rendered streets, not for --image");
    if (options.given("frames") && options.given("wall_direction"))
        throw UsageError("--wall_direction is for one image, not for --frames");
    for (const char* name : {"gyro_rate", "gyro_noise", "gyro_bias", "gyro_delay", "speed_swing", "global"})
        if (!options.given("frames") && options.given(name))
            throw UsageError(std::string("--") + name + " needs --frames");
}

int run(const Options& options)
{
    options.refuseArguments();
    if (!options.given("output"))
        throw UsageError("--output is missing");
    checkTogether(options);
    setThreads(options);

    cv::Mat image;
    if (options.given("image"))
        image = namingFile(options.inputFile("image"), [](const std::string& path) { return readImage(path); });
    const cv::Size size = image.empty() ? parseSize(options.text("size"), "option --size", 2, 20000) : image.size();
    const CameraSettings settings =
        readSettings(options, size, image.empty() ? 816 : 0.9 * std::max(size.width, size.height));
    const Truth truth = readTruthOptions(options, settings);
    if (options.given("frames"))
    {
        writeDrive(options, settings, truth);
        return 0;
    }
    const int samples = options.integer("samples", 1, 16);
    const street::StreetRenderer::Rays rays = raysOf(options);

    const std::string folder = options.outputFile("output") + "/";
    const std::string rolling = folder + "rolling.png", global = folder + "global.png";
    const std::string truthFile = folder + "truth.json", camera = folder + "camera.yml";
    const std::string rollingDepth = folder + "rolling_depth.png", globalDepth = folder + "global_depth.png";
    std::vector<std::string> results = {rolling, global, truthFile, camera};
    if (options.flag("depth"))
        results.insert(results.end(), {rollingDepth, globalDepth});
    checkResults(options, results);

    const street::StreetRenderer renderer(truth.camera, truth.scene);
    Progress progress;
    AtomicFiles files;
    writeImage(files.add(rolling), image.empty() ? renderer.rollingShutter(samples, rays) : distort(image, truth));
    progress.update(1, 2, global);
    writeImage(files.add(global), image.empty() ? renderer.globalShutter(samples, rays) : image);
    if (options.flag("depth"))
    {
        writeImage(files.add(rollingDepth), depthImage(renderer.rollingDepth()));
        writeImage(files.add(globalDepth), depthImage(renderer.globalDepth()));
    }
    const std::string truthContent = truthText(truth), cameraContent = cameraText(settings);
    files.add(truthFile).write(truthContent.data(), truthContent.size());
    files.add(camera).write(cameraContent.data(), cameraContent.size());
    files.commit();
    return 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, KEYS, run, argc, argv);
}
