// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// Puts the page together.
import {AddDialog} from './add_dialog.js';
import {AirCard} from './air_card.js';
import {Clock} from './clock.js';
import {ConnectCard} from './connect_card.js';
import {Connection} from './connection.js';
import {Dodge} from './dodge.js';
import {Drive} from './drive.js';
import {Drops} from './drops.js';
import {Edits} from './edits.js';
import {FaultsPanel} from './faults_panel.js';
import {FirstLook} from './first_look.js';
import {Ground} from './ground.js';
import {Handles} from './handles.js';
import {Hands} from './hands.js';
import {Header} from './header.js';
import {InspectCard} from './inspect_card.js';
import {InspectHand} from './inspect_hand.js';
import {InspectPanel} from './inspect_panel.js';
import {Inspection} from './inspection.js';
import {Keys} from './keys.js';
import {Legend} from './legend.js';
import {Link} from './link.js';
import {Locks} from './locks.js';
import {Mover} from './mover.js';
import {Notices} from './notices.js';
import {Past} from './past.js';
import {Placing} from './placing.js';
import {Pointed} from './pointed.js';
import {PoseHistory} from './pose_history.js';
import {Recorder} from './recorder.js';
import {Ring} from './ring.js';
import {Robots} from './robots.js';
import {Scans} from './scans.js';
import {ScenarioCard} from './scenario_card.js';
import {Selection} from './selection.js';
import {SelectionCard} from './selection_card.js';
import {SensorForm} from './sensor_form.js';
import {SensorsPanel} from './sensors_panel.js';
import {Server} from './server.js';
import {Settings} from './settings.js';
import {SharePanel} from './share_panel.js';
import {Stage} from './stage.js';
import {Status} from './status.js';
import {Strays} from './strays.js';
import {Tabs} from './tabs.js';
import {Tape} from './tape.js';
import {Theme} from './theme.js';
import {Timeline} from './timeline.js';
import {Undo} from './undo.js';
import {Viewpoint} from './viewpoint.js';
import {Views} from './views.js';
import {WirePanel} from './wire_panel.js';
import {World} from './world.js';
import {WorldFile} from './world_file.js';
import {WorldPanel} from './world_panel.js';
import {WorldSaver} from './world_saver.js';
import {askForToken} from './token_dialog.js';
import {byId} from './elements.js';

const page = {};
page.server = new Server(askForToken);
page.settings = new Settings();
page.notices = new Notices(byId('notices'));
page.connection = new Connection(page.server, '/view');
page.status = new Status(page.server);
page.stage = new Stage(byId('canvas'));
page.viewpoint = new Viewpoint(page.stage);
page.ground = new Ground(page.stage, page.viewpoint);
page.world = new World(page.server, page.stage, page.settings);
page.robots = new Robots(page.stage, page.connection, page.world);
page.scans = new Scans(page);
page.selection = new Selection(page.stage, page.world, page.robots);
page.locks = new Locks(page.world);
page.mover = new Mover(page.server, page.robots, page.status, page.notices);
page.clock = new Clock(page);
page.undo = new Undo(page);
page.placing = new Placing(page);
page.edits = new Edits(page);
page.ring = new Ring(page);
page.handles = new Handles(page);
page.hands = new Hands(page);
page.drive = new Drive(page);
page.views = new Views(page);
page.firstLook = new FirstLook(page);
page.link = new Link(page);
page.recorder = new Recorder(page.scans);
page.poseHistory = new PoseHistory(page.robots);
page.past = new Past(page);
page.inspection = new Inspection();
page.pointed = new Pointed(page);
page.tape = new Tape(page);
page.addDialog = new AddDialog(page.edits, page.world);
page.tabs = new Tabs(byId('tabs'), page.settings);
page.theme = new Theme(page);
page.header = new Header(page);
new Legend(page);
new Dodge(page);
new SensorsPanel(page);
new SensorForm(page);
new ConnectCard(page);
new WirePanel(page);
page.scenario = new ScenarioCard(page);
new FaultsPanel(page);
new Drops(page);
new WorldPanel(page);
new WorldFile(page);
new WorldSaver(page);
new AirCard(page);
new SharePanel(page);
new SelectionCard(page);
new InspectHand(page);
new InspectCard(page);
new InspectPanel(page);
new Timeline(page);
new Strays(page);
new Keys(page);

async function loadWorld() {
  try {
    await page.world.load();
  } catch (error) {
    page.notices.trouble(`The world cannot be shown: ${error.message}`);
  }
}

/** Of a daemon that one sees for the first time: the sensors that the link says, or else the first. */
function choose() {
  const {link, settings, scans, status} = page;
  for (const [name, value] of Object.entries(link.settingsWanted)) settings.set(name, value);
  const sensors = status.sensors.map(({name}) => name);
  if (!sensors.includes(settings.get('sensor'))) settings.set('sensor', sensors[0] || '');
  const wanted = link.showWanted || sensors.slice(0, 1);
  scans.showAll(wanted.filter((name) => sensors.includes(name)), true);
}

/** Where one looks in the world, and at what: as the link says, or else at the first scan. */
function look() {
  const {link, selection, views} = page;
  link.begin();
  if (link.viewWanted) views.restore(link.viewWanted);
  else page.firstLook.begin();
  selection.selectLater(link.selectWanted);
  if (link.wanted.follow) views.followLater();
}

page.connection.addEventListener('open', () => page.world.forget());
page.connection.addEventListener('text', (event) => {
  // It comes first, and whenever there is another one.
  if ('scene' in event.detail) loadWorld();
  if (event.detail.detail) page.notices.trouble(event.detail.detail);
});

/** Scans come while the world is still on its way. */
async function begin() {
  await page.server.get('/health');
  page.connection.open();
  const world = loadWorld();
  await page.status.ask();
  choose();
  await world;
  look();
  page.header.begin();
}

begin().catch((error) => page.notices.trouble(`The page cannot begin: ${error.message}`));
