/* A ROS 2 peer without ROS: Cyclone DDS and message definitions. Reads scan, odom, tf, map and plan, writes goal_pose and
 * cmd_vel, and prints every value it has read or written, one a line: `scan ranges[3] 1.25`, a line `scan .` behind each
 * message. Numbers have all their digits. Ends when it is told to, or after a minute.
 *
 *   cyclone_peer DOMAIN */
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>

#include "messages.h"

typedef struct builtin_interfaces_msg_dds__Time_ Time;
typedef struct std_msgs_msg_dds__Header_ Header;
typedef struct geometry_msgs_msg_dds__Vector3_ Vector3;
typedef struct geometry_msgs_msg_dds__Quaternion_ Quaternion;
typedef struct geometry_msgs_msg_dds__Pose_ Pose;
typedef struct geometry_msgs_msg_dds__PoseStamped_ PoseStamped;
typedef struct geometry_msgs_msg_dds__Twist_ Twist;
typedef struct geometry_msgs_msg_dds__TwistStamped_ TwistStamped;
typedef struct geometry_msgs_msg_dds__TransformStamped_ TransformStamped;
typedef struct sensor_msgs_msg_dds__LaserScan_ LaserScan;
typedef struct nav_msgs_msg_dds__OccupancyGrid_ OccupancyGrid;
typedef struct nav_msgs_msg_dds__Odometry_ Odometry;
typedef struct nav_msgs_msg_dds__Path_ Path;
typedef struct tf2_msgs_msg_dds__TFMessage_ TFMessage;

static const char *topic;

static void number(const char *path, const char *name, double value) {
  printf("%s %s%s %.17g\n", topic, path, name, value);
}
static void text(const char *path, const char *name, const char *value) {
  printf("%s %s%s %s\n", topic, path, name, value);
}
static void element(char *out, size_t size, const char *name, unsigned index, const char *rest) {
  snprintf(out, size, "%s[%u]%s", name, index, rest);
}
static void end_message(void) {
  printf("%s .\n", topic);
  fflush(stdout);
}

static void time_stamp(const char *path, const Time *value) {
  number(path, "sec", value->sec);
  number(path, "nanosec", value->nanosec);
}
static void header(const char *path, const Header *value) {
  char inner[128];
  snprintf(inner, sizeof inner, "%sstamp.", path);
  time_stamp(inner, &value->stamp);
  text(path, "frame_id", value->frame_id);
}
static void xyz(const char *path, const char *name, double x, double y, double z) {
  char inner[128];
  snprintf(inner, sizeof inner, "%s%s.", path, name);
  number(inner, "x", x);
  number(inner, "y", y);
  number(inner, "z", z);
}
static void quaternion(const char *path, const char *name, const Quaternion *value) {
  char inner[128];
  xyz(path, name, value->x, value->y, value->z);
  snprintf(inner, sizeof inner, "%s%s.", path, name);
  number(inner, "w", value->w);
}
static void pose(const char *path, const Pose *value) {
  xyz(path, "position", value->position.x, value->position.y, value->position.z);
  quaternion(path, "orientation", &value->orientation);
}
static void twist(const char *path, const Twist *value) {
  xyz(path, "linear", value->linear.x, value->linear.y, value->linear.z);
  xyz(path, "angular", value->angular.x, value->angular.y, value->angular.z);
}
static void covariance(const char *name, const double *values) {
  char path[64];
  for (unsigned i = 0; i < 36; ++i) {
    element(path, sizeof path, name, i, "");
    number(path, "", values[i]);
  }
}
static void floats(const char *name, const float *values, unsigned count) {
  char path[64];
  for (unsigned i = 0; i < count; ++i) {
    element(path, sizeof path, name, i, "");
    number(path, "", (double)values[i]);
  }
}

static void scan(const void *sample) {
  const LaserScan *value = sample;
  header("header.", &value->header);
  number("", "angle_min", (double)value->angle_min);
  number("", "angle_max", (double)value->angle_max);
  number("", "angle_increment", (double)value->angle_increment);
  number("", "time_increment", (double)value->time_increment);
  number("", "scan_time", (double)value->scan_time);
  number("", "range_min", (double)value->range_min);
  number("", "range_max", (double)value->range_max);
  floats("ranges", value->ranges._buffer, value->ranges._length);
  floats("intensities", value->intensities._buffer, value->intensities._length);
}
static void odom(const void *sample) {
  const Odometry *value = sample;
  header("header.", &value->header);
  text("", "child_frame_id", value->child_frame_id);
  pose("pose.pose.", &value->pose.pose);
  covariance("pose.covariance", value->pose.covariance);
  twist("twist.twist.", &value->twist.twist);
  covariance("twist.covariance", value->twist.covariance);
}
static void tf(const void *sample) {
  const TFMessage *value = sample;
  char path[64];
  for (unsigned i = 0; i < value->transforms._length; ++i) {
    const TransformStamped *transform = &value->transforms._buffer[i];
    element(path, sizeof path, "transforms", i, ".header.");
    header(path, &transform->header);
    element(path, sizeof path, "transforms", i, ".");
    text(path, "child_frame_id", transform->child_frame_id);
    element(path, sizeof path, "transforms", i, ".transform.");
    const Vector3 *moved = &transform->transform.translation;
    xyz(path, "translation", moved->x, moved->y, moved->z);
    quaternion(path, "rotation", &transform->transform.rotation);
  }
}
static void map(const void *sample) {
  const OccupancyGrid *value = sample;
  header("header.", &value->header);
  time_stamp("info.map_load_time.", &value->info.map_load_time);
  number("info.", "resolution", (double)value->info.resolution);
  number("info.", "width", value->info.width);
  number("info.", "height", value->info.height);
  pose("info.origin.", &value->info.origin);
  char path[64];
  for (unsigned i = 0; i < value->data._length; ++i) {
    element(path, sizeof path, "data", i, "");
    number(path, "", value->data._buffer[i]);
  }
}
static void pose_stamped(const char *path, const PoseStamped *value) {
  char inner[128];
  snprintf(inner, sizeof inner, "%sheader.", path);
  header(inner, &value->header);
  snprintf(inner, sizeof inner, "%spose.", path);
  pose(inner, &value->pose);
}
static void plan(const void *sample) {
  const Path *value = sample;
  header("header.", &value->header);
  char path[64];
  for (unsigned i = 0; i < value->poses._length; ++i) {
    element(path, sizeof path, "poses", i, ".");
    pose_stamped(path, &value->poses._buffer[i]);
  }
}
static void goal_pose(const void *sample) {
  pose_stamped("", sample);
}
static void cmd_vel(const void *sample) {
  const TwistStamped *value = sample;
  header("header.", &value->header);
  twist("twist.", &value->twist);
}

static dds_entity_t checked(dds_entity_t entity, const char *what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "cyclone_peer: %s: %s\n", what, dds_strretcode(-entity));
  exit(1);
}

/* The QoS of ROS 2's profiles for sensors, latched topics and the rest. */
enum Profile { kSensor, kLatched, kReliable };

static dds_qos_t *qos_of(enum Profile profile) {
  dds_qos_t *qos = dds_create_qos();
  dds_qset_reliability(qos, profile == kSensor ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_durability(qos, profile == kLatched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, profile == kLatched ? 1 : 10);
  return qos;
}

struct Endpoint {
  const char *name; /* on the wire: rt/name */
  const dds_topic_descriptor_t *type;
  enum Profile profile;
  void (*print)(const void *);
  dds_entity_t entity;
};

static void open_endpoint(dds_entity_t participant, struct Endpoint *endpoint, int writes) {
  char name[64];
  snprintf(name, sizeof name, "rt/%s", endpoint->name);
  const dds_entity_t on = checked(dds_create_topic(participant, endpoint->type, name, NULL, NULL), name);
  dds_qos_t *qos = qos_of(endpoint->profile);
  endpoint->entity = checked(writes ? dds_create_writer(participant, on, qos, NULL)
                                    : dds_create_reader(participant, on, qos, NULL),
                             name);
  dds_delete_qos(qos);
}

static void print_sample(const struct Endpoint *endpoint, const void *sample) {
  topic = endpoint->name;
  endpoint->print(sample);
  end_message();
}

static void read_all(const struct Endpoint *reader) {
  void *sample = NULL;
  dds_sample_info_t info;
  while (dds_take(reader->entity, &sample, &info, 1, 1) > 0) {
    if (info.valid_data) print_sample(reader, sample);
    dds_return_loan(reader->entity, &sample, 1);
  }
}

/* Once somebody listens; true from then on. */
static int write_once(const struct Endpoint *writer, const void *sample) {
  dds_publication_matched_status_t matched;
  if (dds_get_publication_matched_status(writer->entity, &matched) < 0 || matched.current_count == 0) return 0;
  if (dds_write(writer->entity, sample) < 0) return 0;
  print_sample(writer, sample);
  return 1;
}

int main(int argc, char **argv) {
  if (argc != 2) {
    fprintf(stderr, "usage: cyclone_peer DOMAIN\n");
    return 2;
  }
  const dds_entity_t participant = checked(dds_create_participant((dds_domainid_t)atoi(argv[1]), NULL, NULL), "participant");
  struct Endpoint readers[] = {{"scan", &sensor_msgs_msg_dds__LaserScan__desc, kSensor, scan, 0},
                               {"odom", &nav_msgs_msg_dds__Odometry__desc, kSensor, odom, 0},
                               {"tf", &tf2_msgs_msg_dds__TFMessage__desc, kReliable, tf, 0},
                               {"map", &nav_msgs_msg_dds__OccupancyGrid__desc, kLatched, map, 0},
                               {"plan", &nav_msgs_msg_dds__Path__desc, kLatched, plan, 0}};
  const size_t reader_count = sizeof readers / sizeof readers[0];
  struct Endpoint goal = {"goal_pose", &geometry_msgs_msg_dds__PoseStamped__desc, kReliable, goal_pose, 0};
  struct Endpoint command = {"cmd_vel", &geometry_msgs_msg_dds__TwistStamped__desc, kReliable, cmd_vel, 0};
  for (size_t i = 0; i < reader_count; ++i) open_endpoint(participant, &readers[i], 0);
  open_endpoint(participant, &goal, 1);
  open_endpoint(participant, &command, 1);

  const PoseStamped goal_value = {{{1700000001, 123456789}, "map"}, {{1.25, -2.5, 0.1}, {0.0, 0.0, 0.6, 0.8}}};
  const TwistStamped command_value = {{{-7, 999999999}, "base_link"}, {{0.1, 0.0, -1e-300}, {0.0, 1e300, 1.0 / 3.0}}};
  int goal_written = 0;
  int command_written = 0;
  for (int step = 0; step < 3000; ++step) {
    for (size_t i = 0; i < reader_count; ++i) read_all(&readers[i]);
    if (!goal_written) goal_written = write_once(&goal, &goal_value);
    if (!command_written) command_written = write_once(&command, &command_value);
    dds_sleepfor(DDS_MSECS(20));
  }
  return dds_delete(participant) < 0;
}
