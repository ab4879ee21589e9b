// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// The reader and writer of MCAP's makers, for tests: `mcap_core.js read FILE` prints what it finds as JSON, both by the
// index and from the beginning; `mcap_core.js write FILE zstd|none|no-chunks [ORDER]` writes scans of ROS 2; a
// scan's place in the file is its number, in which the bits of ORDER are changed.
import {readFile, writeFile} from 'node:fs/promises';
import zstd from '@foxglove/wasm-zstd';
import {McapIndexedReader, McapStreamReader, McapWriter, TempBuffer} from '@mcap/core';
import {loadDecompressHandlers} from '@mcap/support';

const number = (_, value) => typeof value === 'bigint' ? Number(value) : value;

async function byIndex(bytes, decompressHandlers) {
  const reader = await McapIndexedReader.Initialize({readable: new TempBuffer(bytes), decompressHandlers});
  const topics = {};
  const first = {};
  for await (const message of reader.readMessages({validateCrcs: true})) {
    const {topic} = reader.channelsById.get(message.channelId);
    topics[topic] = (topics[topic] ?? 0) + 1;
    first[topic] ??= new TextDecoder().decode(message.data);
  }
  const metadata = [];
  for await (const record of reader.readMetadata()) {
    metadata.push({name: record.name, entries: Object.fromEntries(record.metadata)});
  }
  const channels = [...reader.channelsById.values()].map(({topic, schemaId, messageEncoding}) => {
    const schema = reader.schemasById.get(schemaId);
    return {topic, messageEncoding, schema: schema?.name, schemaEncoding: schema?.encoding,
      schemaData: schema && new TextDecoder().decode(schema.data)};
  });
  return {library: reader.header.library, channels, topics, first, metadata, statistics: reader.statistics,
    chunks: reader.chunkIndexes.map(({compression}) => compression),
    summaryOffsets: reader.summaryOffsetsByOpcode.size};
}

function fromBeginning(bytes, decompressHandlers) {
  const reader = new McapStreamReader({decompressHandlers, validateCrcs: true});
  reader.append(bytes);
  const records = {};
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
    records[record.type] = (records[record.type] ?? 0) + 1;
  }
  return {records, done: reader.done()};
}

/** sensor_msgs/msg/LaserScan in CDR. */
function laserScan(index) {
  const ranges = [1 + index, Infinity, 2.5];
  const view = new DataView(new ArrayBuffer(72 + 4 * ranges.length));
  view.setUint32(0, 0x00010000);
  view.setInt32(4, 1_700_000_000, true);
  view.setUint32(8, index * 25_000_000, true);
  view.setUint32(12, 6, true);
  new Uint8Array(view.buffer).set(new TextEncoder().encode('laser\0'), 16);
  [-1.5, 1.5, 0.25, 0, 0.025, 0.02, 30].forEach((value, i) => view.setFloat32(24 + 4 * i, value, true));
  view.setUint32(52, ranges.length, true);
  ranges.forEach((value, i) => view.setFloat32(56 + 4 * i, value, true));
  return new Uint8Array(view.buffer, 0, 60 + 4 * ranges.length);
}

async function write(file, pack, order) {
  await zstd.isLoaded;
  const buffer = new TempBuffer();
  const compressChunk = pack === 'zstd'
    ? (data) => ({compression: 'zstd', compressedData: zstd.compress(data, 3)}) : undefined;
  const writer = new McapWriter({writable: buffer, useChunks: pack !== 'no-chunks', chunkSize: 300, compressChunk});
  await writer.start({profile: 'ros2', library: 'a test'});
  const register = async (topic, name) => {
    const schemaId = await writer.registerSchema({name, encoding: 'ros2msg', data: new Uint8Array()});
    return await writer.registerChannel({topic, schemaId, messageEncoding: 'cdr', metadata: new Map()});
  };
  const odometry = await register('/odom', 'nav_msgs/msg/Odometry');
  const scan = await register('/scan', 'sensor_msgs/msg/LaserScan');
  for (let place = 0; place < 32; ++place) {
    const i = place ^ order;
    const logTime = 1_700_000_001_000_000_000n + BigInt(i);
    const message = {sequence: i, logTime, publishTime: logTime};
    await writer.addMessage({...message, channelId: scan, data: laserScan(i)});
    await writer.addMessage({...message, channelId: odometry, data: new Uint8Array(5)});
  }
  await writer.end();
  await writeFile(file, buffer.get());
}

const [command, file, pack, order] = process.argv.slice(2);
if (command === 'write') {
  await write(file, pack, Number(order ?? 0));
} else {
  const handlers = await loadDecompressHandlers();
  const bytes = await readFile(file);
  const found = {...await byIndex(bytes, handlers), ...fromBeginning(bytes, handlers)};
  console.log(JSON.stringify(found, number));
}
