// SPDX-License-Identifier: Apache-2.0
// Copyright The scipd authors
//
// A sign that stands above a thing and is as large from everywhere: a triangle with an exclamation mark.
import {CanvasTexture, Sprite, SpriteMaterial} from './three.module.js';

const SIDE_PX = 64;
const SHARE_OF_VIEW = 0.045;
const [YELLOW, BLACK] = ['#ffd23f', '#1a1a1a'];

export function makeWarningSign() {
  const map = new CanvasTexture(drawn());
  const sign = new Sprite(new SpriteMaterial({map, sizeAttenuation: false, depthTest: false}));
  sign.scale.setScalar(SHARE_OF_VIEW);
  sign.center.set(0.5, -0.3);
  sign.renderOrder = 10;
  return sign;
}

function drawn() {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = SIDE_PX;
  const pen = canvas.getContext('2d');
  pen.scale(SIDE_PX / 64, SIDE_PX / 64);
  pen.lineJoin = 'round';
  pen.lineWidth = 6;
  pen.strokeStyle = BLACK;
  pen.fillStyle = YELLOW;
  pen.beginPath();
  pen.moveTo(32, 8);
  pen.lineTo(59, 56);
  pen.lineTo(5, 56);
  pen.closePath();
  pen.stroke();
  pen.fill();
  pen.fillStyle = BLACK;
  pen.fillRect(29, 24, 6, 16);
  pen.fillRect(29, 45, 6, 6);
  return canvas;
}
