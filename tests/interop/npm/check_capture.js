// Reads a capture with the readers of other people, and compares every message with what we say is in it.
//
//   node check_capture.js CAPTURE [VALUES]
//
// VALUES holds a line of JSON a message, in the order of log time (`mcap_values cat --json`). Prints a JSON object: counts a
// topic, how many values were compared, and the first differences. Exit code 1 where there are any.
import { open, readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { McapIndexedReader } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";

const require = createRequire(import.meta.url);
const zstd = require("@foxglove/wasm-zstd");
const lz4 = require("@foxglove/wasm-lz4");
await zstd.isLoaded;
await (lz4.default ?? lz4).isLoaded;

const decompressHandlers = {
  zstd: (buffer, size) => new Uint8Array(zstd.decompress(buffer, Number(size))),
  lz4: (buffer, size) => new Uint8Array((lz4.default ?? lz4)(buffer, Number(size))),
};

class FileReadable {
  constructor(handle) {
    this.handle = handle;
  }
  async size() {
    return BigInt((await this.handle.stat()).size);
  }
  async read(offset, length) {
    const buffer = new Uint8Array(Number(length));
    const { bytesRead } = await this.handle.read(buffer, 0, buffer.length, Number(offset));
    if (bytesRead !== buffer.length) throw new Error(`${bytesRead} of ${length} bytes at ${offset}`);
    return buffer;
  }
}

// Integers of 64 bits as BigInt, where JSON.parse would round them.
const marker = "an integer of many digits: ";
function parseValues(line) {
  const exact = line.replace(/(?<=[:[,])-?\d{16,}(?=[,\]}])/g, (digits) => `"${marker}${digits}"`);
  return JSON.parse(exact, (_, value) =>
    typeof value === "string" && value.startsWith(marker) ? BigInt(value.slice(marker.length)) : value);
}

const special = { NaN: NaN, Infinity: Infinity, "-Infinity": -Infinity };
let compared = 0;

function sameNumber(reference, ours, type) {
  ++compared;
  if (typeof ours === "string") ours = special[ours];
  if (typeof reference === "bigint" || typeof ours === "bigint") return BigInt(reference) === BigInt(ours);
  if (type === "float32") ours = Math.fround(ours);
  return reference === ours || (Number.isNaN(reference) && Number.isNaN(ours));
}

function sameText(reference, ours) {
  ++compared;
  return reference === ours;
}

// The first path at which the values differ, or nothing. The definitions say what to expect, so nothing can be left out.
function difference(definitions, name, reference, ours, path) {
  const definition = definitions.find((d) => d.name === name);
  const fields = definition.definitions.filter((field) => !field.isConstant);
  if (fields.length !== Object.keys(ours).length) return `${path}: other fields`;
  for (const field of fields) {
    const at = path === "" ? field.name : `${path}.${field.name}`;
    const a = reference[field.name];
    const b = ours[field.name];
    if (b === undefined) return `${at}: missing`;
    if (!field.isArray) {
      const found = differenceOfOne(definitions, field, a, b, at);
      if (found) return found;
      continue;
    }
    if (a.length !== b.length) return `${at}: ${a.length} / ${b.length} elements`;
    for (let i = 0; i < a.length; ++i) {
      const found = differenceOfOne(definitions, field, a[i], b[i], `${at}[${i}]`);
      if (found) return found;
    }
  }
}

function differenceOfOne(definitions, field, a, b, path) {
  if (field.isComplex) return difference(definitions, field.type, a, b, path);
  // The reference reader has times as a type of its own, with a name of its own for the nanoseconds.
  if (field.type === "time" || field.type === "duration") {
    const same = sameNumber(a.sec, b.sec, "int32") && sameNumber(a.nsec, b.nanosec, "uint32");
    return same ? undefined : `${path}: ${a.sec}.${a.nsec} / ${b.sec}.${b.nanosec}`;
  }
  const isText = field.type === "string" || field.type === "bool";
  const same = isText ? sameText(a, b) : sameNumber(a, b, field.type);
  return same ? undefined : `${path}: ${a} / ${b}`;
}

const [capture, values] = process.argv.slice(2);
const expected = values ? (await readFile(values, "utf8")).split("\n").filter((line) => line !== "") : undefined;
const handle = await open(capture, "r");
const reader = await McapIndexedReader.Initialize({ readable: new FileReadable(handle), decompressHandlers });

const channels = new Map();
const report = { profile: reader.header.profile, topics: {}, messages: 0, compared: 0, differences: [] };
for (const [id, channel] of reader.channelsById) {
  const schema = reader.schemasById.get(channel.schemaId);
  if (channel.messageEncoding !== "cdr" || schema?.encoding !== "ros2msg") {
    report.differences.push(`${channel.topic}: ${channel.messageEncoding}, ${schema?.encoding}`);
    continue;
  }
  const definitions = parse(new TextDecoder().decode(schema.data), { ros2: true });
  // Times as structs of the definition, not as a type of their own, need no special treatment but their names.
  definitions[0].name ??= schema.name.replace("/msg/", "/");
  channels.set(id, { topic: channel.topic, definitions, reader: new MessageReader(definitions), count: 0 });
  report.topics[channel.topic] = { type: schema.name, messages: 0 };
}

for await (const message of reader.readMessages()) {
  const channel = channels.get(message.channelId);
  if (!channel) continue;
  ++report.topics[channel.topic].messages;
  const decoded = channel.reader.readMessage(message.data);
  const line = expected?.[report.messages++];
  if (expected === undefined) continue;
  const ours = line === undefined ? undefined : parseValues(line);
  let found = ours === undefined ? "a message too many" : undefined;
  if (!found && ours.topic !== channel.topic) found = `topic ${ours.topic}`;
  if (!found && !ours.data) found = `not decoded by us: ${ours.error}`;
  found ??= difference(channel.definitions, channel.definitions[0].name, decoded, ours.data, "");
  if (found && report.differences.length < 10) {
    report.differences.push(`message ${report.messages - 1} of ${channel.topic}: ${found}`);
  }
}
if (expected && expected.length !== report.messages) {
  report.differences.push(`${report.messages} messages read, ${expected.length} expected`);
}
const counted = reader.statistics?.messageCount;
if (counted !== undefined && counted !== BigInt(report.messages)) {
  report.differences.push(`${report.messages} messages read, ${counted} in the statistics`);
}
report.compared = compared;
await handle.close();
console.log(JSON.stringify(report, undefined, 1));
process.exit(report.differences.length > 0 ? 1 : 0);
