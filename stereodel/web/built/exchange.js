(()=>{var{make:w}=document.currentScript.shared;var{CanvasPen:J}=document.currentScript.shared;var{HALO_WIDTH:Z,HATCH_PITCH:Q,HATCH_WIDTH:ee,SERIF:I,STYLES:F,colours:T}=document.currentScript.shared;var{writeNumber:z}=document.currentScript.shared;var{LIGHT:te,Pen:ne,cornersOf:se,textParts:ae,traceDisc:oe}=document.currentScript.shared;var{counted:k}=document.currentScript.shared;var{along:ie}=document.currentScript.shared;var{tableLonlat:re}=document.currentScript.shared;var{lonLatOf:A}=document.currentScript.shared;var{asCount:C}=document.currentScript.shared;var{Kept:W,filled:G,run:le}=document.currentScript.shared;var{poleSeen:ce}=document.currentScript.shared;var Ce=3,je=3,He=class extends ne{#t=[];#e=[];text(e){let[n,t]=[f(this.width),f(this.height)];return`${[`<svg xmlns="http://www.w3.org/2000/svg" width="${n}" height="${t}" viewBox="0 0 ${n} ${t}">`,`<title>${V(e)}</title>`,...this.#t.length>0?[`<defs>${this.#t.join("")}</defs>`]:[],`<rect width="${n}" height="${t}" ${v("fill",this.colours.paper)}/>`,`<g fill="none" stroke-linecap="round" stroke-linejoin="round" font-family='${I}'>`,...this.#e].join(`
`)}
</g>
</svg>
`}draw(e,n,t,s=F[e]){let a=de(n);if(a==="")return;let o=[];s.hatch!==void 0&&o.push(`fill="url(#${this.#o(s.hatch)})"`),s.fill!==void 0&&o.push(v("fill",t??this.colours[s.fill],s.fillOpacity)),s.stroke!==void 0&&o.push(this.#n(s,t)),this.#e.push(`<path class="${e}" ${o.join(" ")} d="${a}"/>`)}within({opacity:e=1,region:n,corner:t},s){let a=`clip-${this.#t.length}`;n&&this.#t.push(`<clipPath id="${a}"><path d="${de(n)}"/></clipPath>`);let o=n?` clip-path="url(#${a})"`:"",r=e<1?` opacity="${e}"`:"",l=t?` transform="translate(${t.map(f).join(" ")})"`:"";this.#e.push(`<g${o}${r}${l}>`),s(),this.#e.push("</g>")}discs(e,n,t){let{radius:s,fill:a,rim:o,rimWidth:r,opacity:l}=n,i=f(s-r/2),c=`dots-${this.#t.length}`,d=[];for(let p=0;p<t.length;p+=2)d.push(`<circle cx="${f(t[p])}" cy="${f(t[p+1])}" r="${i}"/>`);this.#t.push(`<g id="${c}">${d.join("")}</g>`);let h=`fill="none" ${v("stroke",this.colours[o],l)} stroke-width="${f(2*r)}"`;this.#e.push(`<use class="${e}-rim" href="#${c}" ${h}/>`),this.#e.push(`<use class="${e}" href="#${c}" ${v("fill",this.colours[a],l)}/>`)}spots(e,n){let t=this.#n(F["spot-line"]);n.forEach((s,a)=>{let[o,r,l]=[e[3*a],e[3*a+1],e[3*a+2]].map(f);this.#e.push(`<circle class="spot" cx="${o}" cy="${r}" r="${l}" ${v("fill",s)} ${t}/>`)})}label(e,n,t,s){let a={left:"start",center:"middle",right:"end"}[s.align??"left"],o=ae(e,s.italic??!1).map(i=>i.italic?`<tspan font-style="italic">${V(i.text)}</tspan>`:V(i.text)).join(""),r=`paint-order="stroke" ${v("stroke",this.inkOf(s.halo))} stroke-width="${Z}"`,l=`x="${f(n)}" y="${f(t)}" font-size="${s.size}" text-anchor="${a}"`;this.#e.push(`<text ${l} ${v("fill",this.inkOf(s.ink))} ${r}>${o}</text>`)}picture(e,n,t,s,a){if(e instanceof HTMLImageElement){let l=decodeURIComponent(e.src.slice(e.src.indexOf(",")+1));return this.within({corner:[n,t]},()=>this.#e.push(l))}let o=document.createElement("canvas");[o.width,o.height]=[e.width,e.height],o.getContext("2d").drawImage(e,0,0);let r=`x="${f(n)}" y="${f(t)}" width="${f(s)}" height="${f(a)}"`;this.#e.push(`<image ${r} preserveAspectRatio="none" href="${o.toDataURL("image/png")}"/>`)}#n(e,n=this.colours[e.stroke??"ink"]){let t=e.dash===void 0?"":` stroke-dasharray="${e.dash.join(" ")}"`,s=f((e.width??1)*this.weight);return`${v("stroke",n,e.strokeOpacity)} stroke-width="${s}"${t}`}fillDisc({x:e,y:n,r:t},s){let a=typeof s=="string"?v("fill",s):`fill="url(#${this.#a(s)})"`;this.#e.push(`<circle ${a} cx="${f(e)}" cy="${f(n)}" r="${f(t)}"/>`)}#a({id:e,stops:n}){let t=n.map(([a,o])=>`<stop offset="${a}" ${v("stop-color",o,1,"stop-opacity")}/>`),s=Object.entries(te).map(([a,o])=>`${a}="${f((o+(a==="r"?0:1))/2)}"`);return this.#s(e,`<radialGradient id="${e}" ${s.join(" ")}>${t.join("")}</radialGradient>`)}#o(e){let[n,t]=[`hatch-${e}`,Q],s=`M0 ${t/2}H${t}${e==="crossed"?`M${t/2} 0V${t}`:""}`,a=`${v("stroke",this.colours.hatch)} stroke-width="${ee}"`,o=`width="${t}" height="${t}" patternUnits="userSpaceOnUse" patternTransform="rotate(-45)"`;return this.#s(n,`<pattern id="${n}" ${o}><path ${a} d="${s}"/></pattern>`)}#s(e,n){return this.#t.includes(n)||this.#t.push(n),e}};function de(e){let n="";return e({moveTo:(t,s)=>n+=`M${f(t)} ${f(s)}`,lineTo:(t,s)=>n+=`L${f(t)} ${f(s)}`,ellipse(t,s,a,o,r,l,i,c=!1){let[d,h]=[Math.cos(r),Math.sin(r)],p=b=>{let[u,m]=[a*Math.cos(b),o*Math.sin(b)];return[t+u*d-m*h,s+u*h+m*d]};n===""?this.moveTo(...p(l)):this.lineTo(...p(l));let g=Math.ceil(Math.abs(i-l)/je),$=`${f(a)} ${f(o)} ${f(r*180/Math.PI)} 0 ${c?0:1}`;for(let b=1;b<=g;++b){let[u,m]=p(l+(i-l)*b/g);n+=`A${$} ${f(u)} ${f(m)}`}},closePath:()=>n+="Z"}),n}function f(e){return z(e,Ce)}function v(e,n,t=1,s=`${e}-opacity`){let[a,o,r,l=1]=(n.match(/[\d.]+/g)??[]).map(Number),i=l*t,c=i===1?"":` ${s}="${f(i)}"`;return`${e}="rgb(${a}, ${o}, ${r})"${c}`}function V(e){return e.replace(/&/g,"&amp;").replace(/</g,"&lt;").replace(/>/g,"&gt;")}var x={lon:["longitude","lon","lng","long","longitud","longitudine","längengrad","laengengrad","долгота","经度","經度","経度","خط الطول"],lat:["latitude","lat","latitud","latitudine","breitengrad","широта","纬度","緯度","خط العرض"],unsure_lon:["x","xcoord","länge","laenge","الطول"],unsure_lat:["y","ycoord","breite","العرض"],beside:["coord","coords","coordinate","coordinates","point","geo","geogr","geographische","deg","degrees","grad"],missing:["","na","n/a","#n/a","nan","null","none","<na>","-","–"],compass:{E:"East Ost Osten Est Este Leste в.д. 东经 東経 شرقا",W:"West Westen Ouest Oeste Ovest з.д. 西经 西経 غربا",N:"North Nord Norden Norte с.ш. 北纬 北緯 شمالا",S:"South Süd Süden Sud Sur Sul ю.ш. 南纬 南緯 جنوبا"},lettered:"n\\W?s|e\\W?w|[nsew]|\\w*hem\\w*|\\w*(?:lat|lon)\\w*(?:ns|ew|[nsew]|dir|ref)|column_\\d+",zeros:"٠۰０",printed:"−–   　٫．，،",typed:"--    ..,,",unseen:"​‎‏\uFEFF",western:"°ºªà-öø-ÿÀ-ÖØ-ß€‘’“”–—«»²³µ ŒœŠšŽžŸ"},N=/^[-+]?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:e[-+]?[0-9]+)?$/i,Ue=new Set(x.missing),P=e=>Ue.has(e.trim().toLowerCase()),Fe=new RegExp(`\\0|[^\\x00-\\x7f${x.western}]|[^\\x00-\\x7f]{3}`),We="぀";function B(e,n=!1){let[t,s]=["lon","lat"].map(a=>{let[o,r]=[x[a],x[`unsure_${a}`]],c=[d=>o.includes(d),(d,h)=>o.some(p=>h.includes(p)||p>We&&d.includes(p)),(d,h)=>h.length>0&&h.every(p=>r.includes(p))].slice(0,n?2:3).map(d=>e.filter(h=>d(h.trim().toLowerCase(),Ge(h)))).find(d=>d.length>0);return c?.length===1?c[0]:null});return t===null||s===null||t===s?null:[t,s]}function Ge(e){return e.replace(/(?<=[a-z])(?=[A-Z])/g," ").toLowerCase().split(/[^\p{L}]+/u).filter(t=>t!==""&&!x.beside.includes(t))}var Ve=new RegExp(`^(?:${x.lettered})$`,"iu"),Be=new RegExp(`[${x.printed}${x.unseen}]`,"gu");function j(e){return e.replace(Be,t=>x.typed[x.printed.indexOf(t)]??"").trim().replace(/\s+/g," ")}var qe=new Map(Object.entries({...x.compass,O:"O"}).flatMap(([e,n])=>[e,...n.toLowerCase().split(" ")].map(t=>[t,e]))),we=e=>qe.get(e.length>1?e.toLowerCase():e),he="[0-9]+(?:[.,][0-9]*)?",Ye=new RegExp(`^(?<before>[\\p{L}.]+)?\\s*(?<sign>[-+])?\\s*(?<degrees>[0-9]{1,3}(?:[.,][0-9]*)?)(?:\\s*(?:deg(?:rees?)?|[°º˚d:度]|\\s)\\s*(?:(?<minutes>${he})(?:\\s*(?:min|['′’‘´m:分]|\\s)\\s*(?:(?<seconds>${he})\\s*(?:''|’’|′′|["″”“秒]|sec|s)?)?)?)?)?\\s*(?<after>[\\p{L}.]+)?$`,"u");function Xe(e){let n=e.length>200?null:Ye.exec(j(e))?.groups;if(!n)return null;let{before:t,after:s,sign:a}=n,o=[n.degrees,n.minutes,n.seconds].filter(h=>h!==void 0),r=o.map(h=>h.replace(",",".").replace(/\.$/,"")),l=t??s?we(t??s):"",i=o.slice(0,-1).every(h=>/^[0-9]+$/.test(h));return l===void 0||t&&s||l&&a||!i||r.slice(1).some(h=>Number(h)>=60)?null:{degrees:(l==="W"||l==="S"||a==="-"?-1:1)*(l==="O"?NaN:Ke(r)),point:l}}function Ke(e){if(e.length===1)return Number(e[0]);let n=10**(e[e.length-1].split(".")[1]?.length??0);return e.reduce((t,s)=>60*t+Math.round(Number(s)*n),0)/(n*60**(e.length-1))}var $e=/^[-+]?[1-9][0-9]{0,2}[.,][0-9]{3}$/,Je=/^[-+]?0[0-9]/;function Ze(e){let[n,t]=["x","y"].map(s=>e.filter(a=>a.trim().toLowerCase()===s));return n.length===1&&t.length===1?[n[0],t[0]]:e.length===2?[e[0],e[1]]:null}function Qe(e,n,t){let[s,a]=[pe(e,n,"longitude"),pe(e,t,"latitude")];return _e(ke(s,a),e.wrong)}function _e(e,n){for(let t=0;t<e.length/2;++t){let[s,a]=[e[2*t],e[2*t+1]];n.has(t)||(Math.abs(a)>90?n.set(t,`latitude ${a} is outside [-90, 90]; is it the longitude, or not in degrees?`):Math.abs(s)>360&&n.set(t,`longitude ${s} is outside [-360, 360]`))}return e}function et(e,n,t){let s=ve(e.columns),a=[n,t].map(o=>Pe(e,o,e.columns.get(o),r=>xe(r,s)?"may have a decimal mark or thousands; write thousands without one":Re(r)));return ke(a[0],a[1])}function tt(e,n){let t=ve(e),s=l=>N.test(l)&&!Je.test(l)&&!xe(l,t),a=l=>P(l)||s(l.trim()),o=[...e].filter(([l,i])=>!n.has(l)&&i.every(a)&&!i.every(P)),r=l=>P(l)?NaN:Ee(l.trim());return new Map(o.map(([l,i])=>[l,Float64Array.from(i,r)]))}function ve(e){let t=[...e.values()].flatMap(s=>s.filter(a=>/[.,]/.test(a))).map(s=>s.trim()).filter(s=>N.test(s)&&!$e.test(s));return[...new Set(t.map(Se))].join("")||"."}var Se=e=>e.includes(",")?",":".",xe=(e,n)=>$e.test(e)&&Se(e)!==n;function ke(e,n){return Float64Array.from({length:2*e.length},(t,s)=>(s%2===0?e:n)[s>>1])}var Ee=e=>Number(e.replace(",","."));function pe(e,n,t){return Pe(e,t,nt(e,n,t),s=>{let a=N.test(s)?null:Xe(s);if(a===null)return Re(s);let o=a.point===""?t:/[NS]/.test(a.point)?"latitude":"longitude";return o!==t?`is a ${o}`:a.point==="O"?"has an O, which is east in German and west in French; write E or W in its place":a.degrees})}function nt({columns:e},n,t){let[s,a]=[e.get(n),[...e.keys()]],o=a[a.indexOf(n)+1]??"";if(!Ve.test(o))return s;let r=e.get(o).map(c=>P(j(c))?"":j(c)),l=r.filter(Boolean).map(c=>we(c)??"?");return!(l.length>0&&l.every(c=>(t==="latitude"?"NS":"EWO").includes(c)))||s.some(c=>j(c).includes("-")&&!P(c))?s:s.map((c,d)=>P(c)?"":`${c} ${r[d]}`.trim())}var Re=e=>N.test(e)?Ee(e):NaN;function Pe({wrong:e},n,t,s){return Float64Array.from(t,(a,o)=>{let r=a.trim(),l=s(r);if(typeof l=="number"&&Number.isFinite(l))return l;let i=typeof l=="string"?l:"is not a number";return e.has(o)||e.set(o,`the ${n} ${P(r)?"is missing":`'${r}' ${i}`}`),NaN})}var st=[",",";","	","|"],at=50,ot=20,H=/\r\n|\n|\r/,it=/^(?:[ \t]*#[^\r\n]*(?:\r\n?|\n|$))+/;function rt(e){let n=it.exec(e)?.[0]??"",t=e.slice(n.length),s=lt(t),a=n.split(H).length,r=[...s===null?ct(t,a):dt(t,s,a)].filter(({cells:u})=>u.some(m=>m.trim()!==""));if(r.length===0)throw new _("the table is empty: there is not even a line with the names of the columns");let{names:l,data:i}=ht(r),c=i.length<r.length,d=l.find((u,m)=>u!==""&&l.indexOf(u)!==m);if(d!==void 0)throw new _(`there are several columns with the name '${d}'`);let h=l.map(()=>[]),p=new Map,g=l.reduce((u,m,y)=>m===""?u:y+1,0);i.forEach(({cells:u},m)=>{let y=u.length>=g&&u.slice(l.length).every(E=>E===""),[O,D]=[`${u.length} field${u.length===1?"":"s"}`,`${l.length} columns`];y||p.set(m,`has ${O}, but there are ${D}`),h.forEach((E,L)=>E.push(u[L]??""))});let b=l.map((u,m)=>[u||`column_${m+1}`,h[m]]).filter(([,u],m)=>l[m]!==""||u.some(y=>y!==""));return{columns:new Map(b),count:i.length,isHeaded:c,lines:i.map(({line:u})=>u),wrong:p}}function lt(e){let n=e.split(H,at).filter(i=>i.trim()!==""),t=n.map(i=>i.replace(/"[^"]*"/g,"")),a=st.map(i=>({mark:i,widths:t.map(c=>c.split(i).length)})).filter(({widths:i})=>Math.max(0,...i)>1),o=a.filter(({widths:i})=>new Set(i).size===1),r=[...new Set(n.map(i=>i.trim().split(/\s+/).length))];if(a.length===0||o.length===0&&r.length===1&&r[0]>1)return null;let l=({widths:i})=>Math.max(...i.map(c=>c>1?1e6*i.filter(d=>d===c).length+c:0));return(o.length>0?o:a).reduce((i,c)=>l(c)>l(i)?c:i).mark}function*ct(e,n){for(let[t,s]of e.split(H).entries())yield{cells:s.trim().split(/\s+/),line:n+t}}function*dt(e,n,t){let s=`[^"\\${n}\\r\\n][^\\${n}\\r\\n]*`,a=new RegExp(`(?:"([^"]*(?:""[^"]*)*)"|(${s})?)(\\${n}|\\r\\n|\\n|\\r|$)`,"y"),[o,r,l]=[[],t,t];for(;a.lastIndex<e.length;){let i=a.exec(e);if(i===null){let c="a field begins with a quotation mark but does not end with one";throw new _(`line ${r}: ${c}; inside such a field write it twice`)}i[1]!==void 0&&(l+=i[1].split(H).length-1),o.push(i[1]?.replaceAll('""','"')??i[2]??""),i[3]!==n&&(yield{cells:o,line:r},[o,r]=[[],++l])}o.length>0&&(yield{cells:[...o,""],line:r})}function ht(e){let n=e.slice(0,ot).map(({cells:c})=>c.map(d=>d.trim())),t=n.map(c=>c.filter(d=>d!=="")),s=c=>N.test(c),a=t.findIndex((c,d)=>B(c)!==null&&(d===0||!c.some(s))),o=t.findIndex(c=>c.length>1),r=Math.max(0,a>=0?a:o);return a<0&&2*t[r].filter(s).length>t[r].length?{names:n[r].length===2?["lon","lat"]:n[r].map((c,d)=>`column_${d+1}`),data:e.slice(r)}:{names:n[r],data:e.slice(r+1)}}function pt(e,{places:n,names:t,values:s}){let a=i=>typeof i=="string"?/[",\r\n]/.test(i)?`"${i.replaceAll('"','""')}"`:i:Object.is(i,-0)?"-0.0":Number.isFinite(i)?String(i):"",o=[...t?[["name",t]]:[],...s??[]],r=[...e,...o.map(([i])=>i)],l=Array.from({length:n.length/2},(i,c)=>[n[2*c],n[2*c+1],...o.map(([,d])=>d[c])]);return[r,...l].map(i=>`${i.map(a).join()}
`).join("")}var _=class extends Error{columns;constructor(e,n=[]){super(e),this.columns=n}};function ut(e){let n=mt(e),t=R(n,"type")==="Feature"?[n]:R(n,"features");if(!Array.isArray(t))throw new _("the file is not a GeoJSON FeatureCollection of points");let s=new Map,a=t.map((c,d)=>{let h=gt(c);return typeof h=="string"&&s.set(d,h),typeof h=="string"?[NaN,NaN]:h}),o=_e(Float64Array.from(a.flat()),s),r=t.map(c=>R(c,"properties")),l=new Set(r.flatMap(c=>Object.keys(c??{}))),i=new Map([...l].map(c=>[c,r.map(d=>ft(R(d,c)))]));return{places:o,table:{columns:i,count:t.length,isHeaded:!0,lines:[],wrong:s}}}function ft(e){return typeof e=="object"?JSON.stringify(e??void 0)??"":String(e??"")}function R(e,n){return typeof e=="object"&&e!==null?e[n]:void 0}function mt(e){try{return JSON.parse(e)}catch(n){throw new _(`the file is not JSON: ${n instanceof Error?n.message:String(n)}`)}}function gt(e){let n=R(e,"geometry"),[t,s]=[R(n,"type"),R(n,"coordinates")],a=t==="MultiPoint"&&Array.isArray(s)&&s.length===1;if(t!=="Point"&&!a)return`a Point is needed, not ${typeof t=="string"?t:"no geometry"}`;let o=a?s[0]:s,r=Array.isArray(o)?o.slice(0,2):[];return r.length===2&&r.every(Number.isFinite)?r:`a Point has two or three coordinates, not ${JSON.stringify(o)}`}var ue=1e6;async function bt(e,n,t,s){let{text:a,guess:o}=_t(await $t(n),e),r=/^\s*[{[]/.test(a);if(r&&t==="plane")return{room:"globe"};let l=r?ut(a):wt(a,t,s);if("room"in l)return l;let{places:i,table:c,axes:d=[]}=l,{count:h,wrong:p}=c;if(h===0)throw new _("there are no points");if(h>ue){let m=`the page takes up to ${k(ue)}; for more there is the Python library`;throw new _(`there are ${k(h)} points; ${m}`)}let g=p.size===0?"":yt(c);if(p.size===h)throw new _(g);let $=(m,y)=>!p.has(y),b=new Map([...c.columns].map(([m,y])=>[m,y.filter($)])),u=[...b.keys()].find(m=>m.trim().toLowerCase()==="name")??"";return{file:e,places:i.filter((m,y)=>$(0,y>>1)),names:b.get(u)??null,values:tt(b,new Set([...d,u])),leftOut:p.size,wrong:g,guess:o}}function yt({count:e,lines:n,wrong:t}){let s=[...t.keys()].reduce((l,i)=>Math.min(l,i)),a=t.size===e?"No row":`${k(t.size)} of ${k(e)} rows`,o=n.length===0?"":`, on line ${k(n[s])}`,r=t.size===e?"can":"cannot";return`${a} ${r} be placed. Row ${k(s+1)}${o}: ${t.get(s)}`}function wt(e,n,t){let s=rt(e),a=[...s.columns.keys()],o=s.isHeaded?B(a,!0):null,r=t??(n==="lonlat"?B(a):Ze(a));if(r===null&&o!==null)return{room:"globe"};if(r===null)throw new _("the table has no two columns of coordinates",a);let l=(n==="lonlat"?Qe:et)(s,...r),i=[...s.wrong.keys()].filter(c=>Number.isFinite(l[2*c]+l[2*c+1]));return n==="lonlat"&&o===null&&2*i.length>s.count?{room:"lift",columns:r}:{places:l,table:s,axes:r}}async function $t(e){if(!(e[0]===31&&e[1]===139))return e;try{let n=new Blob([e.slice()]).stream().pipeThrough(new DecompressionStream("gzip"));return new Uint8Array(await new Response(n).arrayBuffer())}catch{throw new _("the compressed file is damaged")}}function _t(e,n){let t=String.fromCharCode(...e.subarray(0,2)),s=/^(\xff\xfe|[^\0]\0)/.test(t)?"utf-16le":/^(\xfe\xff|\0)/.test(t)?"utf-16be":null,a=(c,d)=>{try{let h=new TextDecoder(c,{fatal:!0}).decode(e);return/^\s*</.test(h)||d.test(h)?null:h}catch{return null}},o=a(s??"utf-8",/\0/);if(o!==null)return{text:o,guess:null};let r=s===null?a("windows-1252",Fe):null;if(r!==null)return{text:r,guess:"windows-1252"};let l=/^[\w.-]+$/.test(n)?n:`"${n}"`,i="neither a picture nor a table in text that the page can read";throw new _(`${i}; to make a page of it, type: stereodel web ${l}`)}async function Le(e,n,t,s,a){if(e.type.startsWith("image/"))return t.pass("globe",e);let{messages:o}=t,r=`${e.name}:`,l=i=>`${i}${/[.?!]$/.test(i)?"":"."} Nothing has changed.`;try{let i=await bt(e.name,new Uint8Array(await e.arrayBuffer()),n,a);if("room"in i)return t.pass(i.room,e,i.columns);let{leftOut:c,wrong:d,guess:h}=i,p=()=>{o.close(),s(i),h!==null&&o.show(r,`it does not say its encoding; read as ${h}.`)};if(c===0)return p();let g=c===1?"this row":`these ${k(c)} rows`;o.show(r,l(d),{words:`Open without ${g}`,act:p})}catch(i){if(!(i instanceof _))throw i;let c=(...d)=>Le(e,n,t,s,d);i.columns.length>1?vt(e.name,i.columns,n,o,c):o.show(r,l(i.message))}}function vt(e,n,t,s,a){let o=t==="lonlat"?["Longitude","Latitude"]:["x","y"],r=o.map((c,d)=>{let h=w("select","",...n.map(p=>w("option","",p)));return h.selectedIndex=Math.min(d,n.length-1),h}),l={words:"Open",act:()=>a(r[0].value,r[1].value)},i=o.map((c,d)=>w("label","field column",`${c} `,r[d]));s.show(`Which columns of ${e}?`,"",l,i)}var St=7;function xt(e,n="spherical"){return`{"type":"FeatureCollection","features":[
${e.map(({properties:s,corners:a})=>{let o=a.length===0?kt:Et(a,n);return JSON.stringify({type:"Feature",properties:s,geometry:o})}).join(`,
`)}
]}
`}var kt={type:"Polygon",coordinates:[[...se(-180,-90,180,90),[-180,-90]]]};function Et(e,n){let t=Rt(e.flatMap((l,i)=>ie(l,e[(i+1)%e.length])),n),s=Math.round((t[t.length-1][0]-t[0][0])/360),a=s===0?t:Pt(t,s),o=l=>Number(l.toFixed(St)),r=Lt(a).map(l=>[l.map(([i,c])=>[o(i),o(c)])]);return r.length===1?{type:"Polygon",coordinates:r[0]}:{type:"MultiPolygon",coordinates:r}}function Rt(e,n){let t=re(Float64Array.from([...e,e[0]].flatMap(A)),n),s=[];for(let a=0;a<t.length;a+=2){let o=s[s.length-1]?.[0]??t[a];s.push([t[a]+360*Math.round((o-t[a])/360),t[a+1]])}return s}function Pt(e,n){let t=n>0?90:-90,s=n>0?[...e]:[...e].reverse(),a=360*Math.ceil((s[0][0]-180)/360)+180,o=s.findIndex(([h])=>h>=a),r=Te(s[Math.max(0,o-1)],s[o===-1?s.length-1:o],a),l=s.slice(Math.max(o,0),-1).map(([h,p])=>[h-a-180,p]),i=s.slice(0,Math.max(o,0)).map(([h,p])=>[h-a+180,p]),c=[[-180,r],...l,...i,[180,r]],d=n>0?c:c.reverse();return[...d,[d[d.length-1][0],t],[d[0][0],t],d[0]]}function Te(e,n,t){return e[0]===n[0]?e[1]:e[1]+(t-e[0])/(n[0]-e[0])*(n[1]-e[1])}function Lt(e){let n=e.map(([o])=>o),t=Math.floor((Math.min(...n)+180)/360),s=Math.ceil((Math.max(...n)+180)/360),a=[];for(let o=t;o<Math.max(s,t+1);++o){let r=e.slice(0,-1).map(([i,c])=>[i-360*o,c]),l=fe(fe(r,-180,1),180,-1);l.length>2&&a.push([...l,l[0]])}return a}function fe(e,n,t){let s=[];return e.forEach((a,o)=>{let r=e[(o+1)%e.length],[l,i]=[t*(a[0]-n)>=0,t*(r[0]-n)>=0];l&&s.push(a),l!==i&&a[0]!==n&&r[0]!==n&&s.push([n,Te(a,r,n)])}),s}var me=Float64Array.of(-Math.PI,-Math.PI/2,Math.PI,Math.PI/2),ge=2**15,Tt=class{width;height;texels;levels;constructor(e,n){if(this.width=C(n,"width",2,2**20),this.height=n/2,e.length!==4*this.width*this.height){let a=`four for each of ${n} × ${this.height} pixels: a picture of the whole globe`;throw new RangeError(`pixels has ${e.length} numbers, and not ${a} is twice as wide as high`)}this.texels=new W(At(e));let t=le(a=>a.call("raster_levels_size",this.width,this.height)),s=[this.texels,this.width,this.height,me];this.levels=new W(G(Uint8Array,t,"raster_levels",...s))}warp(e,n){return this.painted(e,[-1,1,2/n,2/n],n,n)}painted(e,n,t,s,a=!0){C(t,"width",1,ge),C(s,"height",1,ge);let o=e.inverse(),r=Float64Array.of(...o.right.matrix,o.magnification,...o.left.matrix,0),i=[...[this.texels,this.levels,this.width,this.height,me],r,Float64Array.of(...n),t,s,a?1:0];return G(Uint8ClampedArray,4*t*s,"warp_raster",...i)}};function At(e){let n=Uint8Array.from(e);for(let t=0;t<n.length;++t)t%4!==3&&(n[t]=Math.floor((n[t]*n[t|3]+127)/255));return n}var Dt=4096,Nt=2,Ot=.25,[Mt,It]=[.6,120],zt=.01;async function Ct(e,n,t){let s=await createImageBitmap(e).catch(()=>null);if(s===null||Math.abs(s.width/s.height-2)>zt){let l=s&&`is ${s.width} × ${s.height}; one of the whole sphere is twice as wide as high`;n.show(`${e.name}:`,`the picture ${l??"cannot be read"}. Nothing has changed.`);return}let a=Math.round(Math.min(s.width,Dt)/2),o=w("canvas",{width:2*a,height:a}),r=o.getContext("2d",{willReadFrequently:!0});r.drawImage(s,0,0,o.width,o.height),s.close(),n.close(),t(new jt(e.name,r.getImageData(0,0,o.width,o.height)))}var jt=class{name;#t;#e;letters;constructor(e,n){this.name=e,this.#t=new Tt(n.data,n.width),this.#e=Ft(n);let t=[0,0,0];for(let i=0;i<n.data.length;++i)i%4<3&&(t[i%4]+=n.data[i]);let s=t.map(i=>4*i/n.data.length),a=.3*s[0]+.59*s[1]+.11*s[2]>It,o=s.map(i=>Math.round(i+Mt*((a?255:0)-i))),[r,l]=a?["27, 27, 27","171, 67, 0"]:["255, 255, 255","245, 160, 98"];this.letters={ink:`rgb(${r})`,accent:`rgb(${l})`,halo:`rgb(${o.join(", ")})`}}draw(e,n,t,s){let a=s&&this.#e===null?Ot:Math.min(Nt,devicePixelRatio),o=Math.max(1,Math.ceil(2*n.r*a)),r=s&&this.#e!==null?this.#e(t,o):this.#n(t,o);e.within({region:l=>oe(l,n)},()=>e.picture(r,n.x-n.r,n.y-n.r,2*n.r,2*n.r))}#n(e,n){let t=w("canvas",{width:n,height:n}),s=new ImageData(this.#t.painted(e,[-1,1,2/n,2/n],n,n,!1),n,n);return t.getContext("2d").putImageData(s,0,0),t}},Ht=`#version 300 es
out vec2 place;
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
  gl_Position = vec4(place, 0.0, 1.0);
}`,Ut=`#version 300 es
precision highp float;
in vec2 place;
uniform sampler2D picture;
uniform mat3 left, right;
uniform float magnification;
out vec4 colour;
const float PI = 3.14159265358979;
void main() {
  float square = dot(place, place);
  vec3 seen = vec3(place, sqrt(max(0.0, 1.0 - square)));
  vec3 v = seen * left;
  float s = magnification, up = 1.0 + v.z, down = 1.0 - v.z;
  vec3 w = vec3(2.0 * s * v.xy, up - s * s * down) / (up + s * s * down) * right;
  vec2 at = vec2(atan(w.y, w.x) / (2.0 * PI) + 0.5, 0.5 - asin(clamp(w.z, -1.0, 1.0)) / PI);
  vec2 dx = dFdx(at), dy = dFdy(at);
  dx.x -= round(dx.x);
  dy.x -= round(dy.x);
  colour = square <= 1.02 ? textureGrad(picture, at, dx, dy) : vec4(0.0);
}`;function Ft(e){let n=w("canvas"),t=n.getContext("webgl2",{antialias:!1,depth:!1,alpha:!0});if(t===null||t.getParameter(t.MAX_TEXTURE_SIZE)<e.width)return null;let s=t.createProgram();for(let[a,o]of[[t.VERTEX_SHADER,Ht],[t.FRAGMENT_SHADER,Ut]]){let r=t.createShader(a);t.shaderSource(r,o),t.compileShader(r),t.attachShader(s,r)}return t.linkProgram(s),t.getProgramParameter(s,t.LINK_STATUS)?(t.useProgram(s),t.bindTexture(t.TEXTURE_2D,t.createTexture()),t.texImage2D(t.TEXTURE_2D,0,t.RGBA,t.RGBA,t.UNSIGNED_BYTE,e),t.generateMipmap(t.TEXTURE_2D),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MIN_FILTER,t.LINEAR_MIPMAP_LINEAR),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_S,t.REPEAT),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_T,t.CLAMP_TO_EDGE),({left:a,right:o,magnification:r},l)=>{n.width!==l&&(n.width=n.height=l),t.viewport(0,0,l,l);for(let[i,{matrix:c}]of Object.entries({left:a,right:o}))t.uniformMatrix3fv(t.getUniformLocation(s,i),!0,new Float32Array(c));return t.uniform1f(t.getUniformLocation(s,"magnification"),1/r),t.drawArrays(t.TRIANGLES,0,3),n}):null}var q={ink:"ink",halo:"paper",size:24,align:"center"},be={...q,ink:"ink-2",size:13};async function Ae(e,n){let{width:t,paint:s,owner:a}=e;if(!a)return e;let o=ye(a.title,1.9*t/q.size),r=o.length*30+(o.length>0?6:0),l=new Image;if(a.legend){let h=a.legend.replace("<svg ",`<svg color="${n}" font-family='${I}' `);l.src=`data:image/svg+xml,${encodeURIComponent(h)}`,await l.decode()}let i=r+e.height+8,c=ye(a.source,2.1*t/be.size),d=i+l.height;return{...e,title:a.title?`${a.title}. ${e.title}`:e.title,height:d+(c.length>0?c.length*17+10:0),paint(h){o.forEach((p,g)=>h.label(p,t/2,26+30*g,q)),h.within({corner:[0,r]},()=>s(h)),a.legend&&h.picture(l,(t-l.width)/2,i,l.width,l.height),c.forEach((p,g)=>h.label(p,t/2,d+14+17*g,be))}}}function ye(e,n){let t=[];for(let s of e.split(/\s+/).filter(Boolean)){let a=t[t.length-1];a!==void 0&&a.length+s.length<n?t[t.length-1]=`${a} ${s}`:t.push(s)}return t}var Wt=`from dataclasses import replace

import numpy as np
from stereodel import SphereCircle, SphericalDelaunay, SphericalVoronoi, bubble_to_bubble, fisheye, lonlat_to_xyz
from stereodel.drawing import ColorScale, DotStyle, LineStyle, SizeScale, View, as_color
from stereodel.globe import Globe, Panel, panels
from stereodel.interpolation import contours
from stereodel.io import read_points

RED, WASH = LineStyle("#d55e00", 1.8), "#d55e0021"
radius = 1.349  # of circles of 150 km, degrees
[!bubble] focus = {focus}
[!bubble] lens = fisheye(focus, magnification={magnification})
[bubble] taken, filled = SphereCircle.around({taken}), SphereCircle.around({filled})
[bubble] lens = bubble_to_bubble(taken, filled)
[owned] table = {file}  # as the page exports it
[owned] places = table.lonlat
[!owned places] places = {places}
[scaled] values, scale = table.column({valued}), {scale}
[scaled isolines] net = SphericalDelaunay.from_lonlat(places{latitude})
[scaled isolines] levels = [tick for tick in scale.ticks if scale.low < tick < scale.high]
[scaled isolines] isolines = [line.lonlat for line in contours(net, values, levels)]
[scaled fills] shades = scale(values)
[owned !scaled] shades = {shades}


def earth():
    globe = Globe(ocean="#dde9f1", limb=LineStyle("#4d4d4d", 1.3){latitude}{title})
[picture]     globe.add_raster({picture})
[!picture land]     globe.add_land(color="#f4eddd", resolution="{resolution}")
[!picture land]     globe.add_coastlines(style=LineStyle("#405466", 0.7), resolution="{resolution}")
[owned fills]     globe.add_cells(SphericalVoronoi.from_lonlat(places{latitude}), colors=shades, style=None)
[owned fills !picture]     globe.add_coastlines(style=LineStyle("#405466", 0.7), resolution="{resolution}")
[graticule]     globe.add_graticule(10, style=LineStyle("#a9b5be", 0.5))
[tissot]     globe.add_tissot(10, radius, color="#40546629", style=LineStyle("#405466", 0.6))
[places cells]     cells = SphericalVoronoi.from_lonlat(places{latitude})
[places cells]     globe.add_cells(cells, style=LineStyle("#1b1b1b", 1.1))
[scaled isolines]     for style in (LineStyle("#fdfcfa", 2.4), LineStyle("#1b1b1b", 0.8)):
[scaled isolines]         globe.add_lines(isolines, style=style, name="isolines")
[owned]     globe.add_points(places, {points})
[places !owned]     globe.add_points(places, style=DotStyle("#1b1b1b", 2.5, "#fdfcfa", 0.6))
[pointed]     globe.add_circles([SphereCircle.around({pointer}, radius)], color=WASH, style=RED)
[named names]     globe.add_labels(places, {words}, size=13.0, movable=True)
    return globe


[!bubble] globe = earth()
[!bubble !owned] globe.add_points([focus], style=DotStyle("#fdfcfa", 5.9, RED.color, 1.8))
[!bubble !owned] globe.add_labels([focus], ["focus"], offset=(9.0, 7.0), color="#ab4300", font="italic", size=15.0)
[!bubble !owned] page = globe.page(lens, View({view}), width={width})
[!bubble owned] page = globe.page(lens, View({view}), width={width}, legend=True)
[bubble] before, after = earth(), earth()
[bubble] before.add_circles([taken], color=WASH, style=RED, name="rim")
[bubble] after.add_circles([taken], color=None, style=RED, name="rim")
[bubble] page = panels([Panel(before, None, View({before})), Panel(after, lens, View({view}))], width={width})
[bubble] page = replace(page, items=tuple(sorted(page.items, key=lambda item: item.name == "rim")))  # over the limb
replace(page.shaded(0.7), background=as_color("#fdfcfa")).save("globe.svg")
`,Gt=`import numpy as np

from stereodel import PlanarDelaunay, PlanarVoronoi, SphereArc, SphereCircle, SphericalDelaunay, SphericalVoronoi, Stereographic, in_bubble
from stereodel.drawing import DotStyle, LineStyle, Polylines, Scene, Sketch, View

points = {points}
low, high = {corners}  # of the sheet
middle, diagonal = (low + high) / 2, np.hypot(*(high - low)) or 1.0
corners = np.array([low, [high[0], low[1]], high, [low[0], high[1]]])
sheet, view = PlanarDelaunay(points), View({view})
width, height, scale, contact = {width}, {height}, {scale}, np.array([{contact}])  # scale: of a diagonal
INK, GRAY, RED = LineStyle("#1b1b1b", 1.1), LineStyle("#7b7b7b", 0.9), LineStyle("#d55e00", 1.8)
HULL, SIDE, LIMB = LineStyle("#6d8598", 1.3), LineStyle("#7b7b7b", 1.3), LineStyle("#4d4d4d", 0.7)
PAPER, RAY, DOT = "#fdfcfa", LineStyle("#d55e00", 0.8, (5.0, 4.0)), DotStyle("#1b1b1b", 2.5, "#fdfcfa", 0.6)
sketch = Sketch()


def in_plane(xy):
    """Where places of the sheet are on the picture, before they are lifted."""
    uv = scale * (xy - middle) / diagonal
    return contact + view.project(np.concatenate([uv, 0 * uv[..., :1]], axis=-1))


[seeing facets] def hatch(chosen):
[seeing facets]     """Lines 45° steep, 6 points apart, where places of the picture are chosen."""
[seeing facets]     reach = np.hypot(width, height) / 2
[seeing facets]     along, across = np.arange(-reach, reach), np.arange(-reach, reach, 6.0)[:, None]
[seeing facets]     places = np.stack([along - across, along + across], axis=-1) / np.sqrt(2) + [width / 2, height / 2]
[seeing facets]     row, end = np.nonzero(np.diff(chosen(places), axis=1, prepend=False, append=False))
[seeing facets]     ends = places[row, np.minimum(end, len(along) - 1)].reshape(-1, 2, 2)
[seeing facets]     sketch.add_segments(ends, name="hatch", style=LineStyle("#9db0c0", 0.8))


[flat seeing facets] def outside(places):
[flat]     axes = np.linalg.inv(view.project(np.eye(3)[:2]))
[flat]     xy = (places - contact) @ axes * diagonal / scale + middle
[flat]     return ((low <= xy) & (xy <= high)).all(axis=-1) & (sheet.find_simplex(xy.reshape(-1, 2)).reshape(xy.shape[:2]) < 0)


[flat] sketch.add_polygon(in_plane(corners), name="sheet", color="#9db4c847")
[flat seeing facets] hatch(outside)
[flat seeing facets] sketch.add_edges(in_plane(points), sheet.convex_hull, name="hull", style=HULL)
[flat triangles] sketch.add_edges(in_plane(points), sheet.edges, name="delaunay", style=INK)
[flat cells facets] sketch.add_segments(in_plane(PlanarVoronoi(sheet).segments((*low, *high))[0]), name="voronoi", style=GRAY)
[flat] sketch.add_polyline(in_plane(corners), closed=True, name="side", style=SIDE)
[flat] images = in_plane(points)
[flat pair] sketch.add_segment(*images[[{pair}]], name="span", style=RED)
[flat] sketch.add_points(images, name="sites", style=DOT)
[!flat] radius = scale / (4 * np.tan(np.radians({corner}) / 2))
[!flat] projection, center = Stereographic((-90, 90), radius=radius), np.array([0.0, 0.0, -radius])


[!flat] def lifted(xy):
[!flat]     return projection.inverse(scale * (xy - middle) / diagonal)


[!flat] def outside(places):
[!flat]     axes = view.raised((places - contact - view.project(center)) / radius).reshape(-1, 3)
[!flat]     chosen, seen = np.zeros(len(axes), dtype=bool), np.isfinite(axes[:, 2])
[!flat]     xy = projection.forward(axes[seen] @ view.matrix) * diagonal / scale + middle
[!flat]     chosen[seen] = sheet.find_simplex(np.nan_to_num(xy, nan=1e300, posinf=1e300, neginf=-1e300)) < 0
[!flat]     return chosen.reshape(places.shape[:2])


[!flat] xyz = lifted(points)
[!flat] front, glass, span = (Scene(radius=radius, center=center, style=style, limb=LIMB) for style in ("solid", "glass", "none"))
[!flat seeing facets] uv = (points - middle) * 2.0 ** -np.round(np.log2(diagonal))  # rays that are exact
[!flat seeing facets] hull = SphericalDelaunay(np.column_stack([2 * uv, 1 - (uv**2).sum(axis=1)]))
[!flat seeing facets] closing = hull.simplices[in_bubble(*hull.points[hull.simplices].swapaxes(0, 1), (0, 0, -1)) >= 0]
[!flat seeing facets] front.add_edges(xyz, closing[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), name="hull", style=HULL)
[!flat] sketch.add_items(item for item in front.layout(view, at=contact) if item.name in {shown})
[!flat seeing facets] hatch(outside)
[!flat area] ends = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
[!flat area] through = lifted(np.stack([ends[:, 0], ends.mean(axis=1), ends[:, 1]], axis=1))
[!flat area] sides = [SphereArc(SphereCircle.through(*three), three[0], three[2]) for three in through]
[!flat area] glass.add_region(sides, name="sheet", color="#9db4c847")
[!flat triangles] glass.add_edges(xyz, sheet.edges, name="delaunay", style=INK)
[!flat area] glass.add_arcs(sides, name="side", style=SIDE)
[!flat] sketch.add_items(item for item in glass.layout(view, at=contact) if item.name not in ("ball", "limb"))
[!flat cells facets] steps = np.stack([arc.sample(65) for arc in SphericalVoronoi(xyz).ridge_arcs()], axis=1)
[!flat cells facets] xy = projection.forward(steps) * diagonal / scale + middle
[!flat cells facets] inside = ((low <= xy) & (xy <= high)).all(axis=-1) & (view.depth(steps) >= 0)
[!flat cells facets] pieces = np.stack([steps[:-1], steps[1:]], axis=2)[inside[:-1] & inside[1:]].reshape(-1, 3)
[!flat cells facets] lines = contact + view.project(center + radius * pieces)
[!flat cells facets] sketch.add_items([Polylines(lines, np.arange(0, len(lines) + 1, 2), GRAY.color, GRAY.width, "voronoi")])
[!flat] images = contact + view.project(center + radius * xyz)
[!flat] sketch.add_points(images[view.depth(xyz) >= 0], name="sites", style=DOT)
[!flat] sketch.add_polygon(in_plane(corners), name="plane", color="#9db4c819")
[!flat] sketch.add_polyline(in_plane(corners), closed=True, name="frame", style=LIMB)
[!flat triangles] sketch.add_edges(in_plane(points), sheet.edges, name="flat", style=LineStyle("#1b1b1b61", 1.1))
[!flat] for arm in ([4.5, 0.0], [0.0, 3.5]):
[!flat]     sketch.add_segment(contact - arm, contact + arm, name="contact", style=LineStyle("#1b1b1b", 1.0))
[!flat pair] span.add_edges(xyz, [[{pair}]], name="span", style=RED)
[!flat pair] sketch.add_items(span.layout(view, at=contact))
[!flat pole] pole = contact + view.project(2 * center)
[letters] for site, letter in zip([{pair}], "PQ"):
[letters]     above = in_plane(points[site])
[!flat letters rays pole]     sketch.add_segment(pole, above, name="ray", style=RAY)
[!flat letters rays !pole]     sketch.add_segment(images[site], above, name="ray", style=RAY)
[letters !flat]     sketch.add_points(above, name="shadow", style=DotStyle(PAPER, 2.8, RED.color, 1.2))
[letters]     sketch.add_points(images[site], name="held", style=DotStyle(RED.color, 3.7, PAPER, 1.0))
[letters]     sketch.add_label(above, f"\${letter}$", (0.0, 9.0), valign="baseline", size=17.0, color="#ab4300")
[!flat pole] sketch.add_points(pole, name="pole", style=DotStyle("#1b1b1b", 2.3, PAPER, 0.6))
sketch.page((0, width, 0, height), width=width, background=PAPER).shaded(0.33).save("lift.svg")
`,Vt=`import numpy as np

from stereodel import PlanarDelaunay, PlanarVoronoi, PlaneLine, SphereArc, SphereCircle, SphericalDelaunay, SphericalVoronoi, Stereographic, fisheye, in_bubble, lonlat_to_xyz
from stereodel.data import airports, cities, stars
from stereodel.drawing import DotStyle, Fill, LineStyle, Scene, Sketch, View, as_color
from stereodel.io import read_points
from stereodel.triangulation import planar_part

lonlat = {sites}
delaunay = SphericalDelaunay.from_lonlat(lonlat)
points, pole, view = delaunay.points, lonlat_to_xyz(({pole})), View({view})
[facets] sees_pole = in_bubble(*points[delaunay.simplices].swapaxes(0, 1), pole) >= 0
[facets] triangles = delaunay.simplices[~sees_pole]  # those of the plane
[facets] sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
[facets] edges, count = np.unique(sides, axis=0, return_counts=True)  # those of the hull are sides of one triangle

size, ball, gap = {size}, {ball}, {gap}  # of each picture, of the ball, between the pictures
left, right = np.array([0.5 * size, 0.5 * size]), np.array([1.5 * size + gap, 0.5 * size])
frame = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * (size / 2 - 1)
projection = Stereographic(-pole, radius=frame.max() / {reach})
shift = frame.max() / {reach} * np.array([{middle}])
flat = projection.forward(points) - shift
flat[(points == pole).all(axis=1)] = 1e9  # a site at the pole is far away
lens = fisheye({lens})
scene, sketch = Scene(limb=LineStyle("#4d4d4d", 1.3)), Sketch()
INK, GRAY, HULL = LineStyle("#1b1b1b", 1.1), LineStyle("#7b7b7b", 0.9), LineStyle("#6d8598", 1.3)
RED, WASH, PAPER = LineStyle("#d55e00", 1.8), "#d55e0021", "#fdfcfa"
DOT, HELD = DotStyle("#1b1b1b", 2.5, PAPER, 0.6), DotStyle(RED.color, 3.7, PAPER, 1.0)


def arcs(pairs):
    """Great circles between sites, through the lens."""
    return [lens.image_of(SphereArc.great(points[a], points[b])) for a, b in pairs]


def path(corners):
    return np.linspace(corners, np.roll(corners, -1, axis=0), 4, axis=1)


[hatched facets] along, across = np.arange(-size, size), np.arange(-size, size, 6.0)[:, None]
[hatched facets] steep = np.stack([along - across, along + across], axis=-1) / np.sqrt(2)  # lines, 6 points apart


[hatched facets] def hatch(middle, chosen, lines=steep):
[hatched facets]     """The parts of lines of a picture that are chosen."""
[hatched facets]     row, end = np.nonzero(np.diff(chosen(lines), axis=1, prepend=False, append=False))
[hatched facets]     ends = middle + lines[row, np.minimum(end, len(along) - 1)].reshape(-1, 2, 2)
[hatched facets]     sketch.add_segments(ends, name="hatch", style=LineStyle("#9db0c0", 0.8))


[hatched facets] def on_ball(facets, beyond):
[hatched facets]     """Chooses what lies on some facets, and beyond all triangles of the sphere or not."""
[hatched facets]     def chosen(places):
[hatched facets]         axes, found = view.raised(places / ball), np.zeros(places.shape[:2], dtype=bool)
[hatched facets]         seen = np.isfinite(axes[..., 2])
[hatched facets]         found[seen] = np.append(facets, beyond)[delaunay.find_simplex(lens.inverse()(axes[seen] @ view.matrix))]
[hatched facets]         return found
[hatched facets]     return chosen


[seeing facets] hull = PlanarDelaunay(flat[np.unique(triangles)])
[seeing facets] hatch(right, lambda places: hull.find_simplex(places.reshape(-1, 2)).reshape(places.shape[:2]) < 0)
[triangles facets] sketch.add_edges(right + flat, edges, name="delaunay", style=INK)
[triangles facets] scene.add_arcs(arcs(delaunay.edges), name="delaunay", style=INK)
[cells facets] ridges, _ = PlanarVoronoi(flat[np.unique(triangles)]).segments((-size, -size, size, size))
[cells facets] sketch.add_segments(right + ridges, name="voronoi", style=GRAY)
[cells] ridge_arcs = map(lens.image_of, SphericalVoronoi(delaunay).ridge_arcs())
[cells] scene.add_arcs(ridge_arcs, name="voronoi", style=GRAY)
[seeing facets] sketch.add_edges(right + flat, edges[count == 1], name="hull", style=HULL)
[seeing facets] scene.add_arcs(arcs(edges[count == 1]), name="hull", style=HULL)
[bubble aimed] triangle = delaunay.simplices[delaunay.find_simplex(lonlat_to_xyz(({aim})))]
[bubble aimed] bubble, pairs = SphereCircle.through(*points[triangle]), np.column_stack([triangle, np.roll(triangle, -1)])
[bubble aimed] scene.add_cap(lens.image_of(bubble), name="bubble", color=WASH)
[bubble aimed] scene.add_circles([lens.image_of(bubble)], style=RED)
[bubble aimed] scene.add_arcs(arcs(pairs), name="triangle", style=LineStyle(RED.color, 1.2))
[bubble aimed] image = projection.image_of(bubble)
[bubble aimed] if isinstance(image, PlaneLine):
[bubble aimed]     far = 9 * size * image.direction
[bubble aimed]     sketch.add_segment(right - shift + image.point - far, right - shift + image.point + far, name="circle", style=RED)
[bubble aimed] else:
[bubble aimed]     paths = [path(right - shift + image.sample(720))] + [path(right + frame)] * image.outside
[bubble aimed]     sketch.add_items([Fill(tuple(paths), as_color(WASH), "bubble")])
[bubble aimed]     sketch.add_circle(right - shift + image.center, image.radius, name="circle", style=RED)
[bubble aimed]     if not image.outside:
[bubble aimed]         sketch.add_edges(right + flat, pairs, name="triangle", style=LineStyle(RED.color, 1.2))
[step] before, new = SphericalDelaunay(points[: {step} - 1]), {step} - 1
[step] opened = before.simplices[in_bubble(*points[before.simplices].swapaxes(0, 1), points[new]) > 0]
[step] sides = opened[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2).tolist()
[step] fan = np.array([[a, b, new] for a, b in sides if [b, a] not in sides], dtype=int).reshape(-1, 3)
[step] flat_fan = fan[in_bubble(*points[fan].swapaxes(0, 1), pole) < 0]
[step] for corners in fan[np.linalg.det(points[fan]) > 0].tolist():  # others close the hull
[step]     scene.add_region(arcs(zip(corners, corners[1:] + corners[:1])), name="opened", color=WASH)
[step] for corners in flat_fan:
[step]     sketch.add_polygon(right + flat[corners], name="opened", color=WASH)
[step] planar = planar_part(before, pole)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
[step] scene.add_arcs(arcs(before.edges), name="delaunay", style=INK)
[step] sketch.add_edges(right + flat, np.unique(np.sort(planar, axis=1), axis=0), name="delaunay", style=INK)
[step] scene.add_arcs(arcs(fan[:, [2, 0]]), name="fan", style=LineStyle(RED.color, 1.0, (4.0, 3.0)))
[step] spokes = np.unique(flat_fan[:, [2, 0, 2, 1]].reshape(-1, 2), axis=0)
[step] sketch.add_edges(right + flat, spokes, name="fan", style=LineStyle(RED.color, 1.0, (4.0, 3.0)))
[step] scene.add_arcs(arcs(fan[:, :2]), name="horizon", style=RED)
[step] sketch.add_edges(right + flat, flat_fan[:, :2], name="horizon", style=RED)
sketch.add_points((right + flat)[:{step}], name="sites", style=DOT)
scene.add_points(lens(points)[:{step}], name="sites", style=DOT)
[held] sketch.add_points((right + flat)[[{held}]], name="held", style=HELD)
[held] scene.add_points(lens(points)[[{held}]], name="held", style=HELD)
around = Fill((path(right + 9 * frame), path(right + frame)), as_color(PAPER), "paper")
sketch.add_items([around]).add_polyline(right + frame, closed=True, name="frame", style=LineStyle("#4d4d4d", 0.7))
ground, *items = scene.layout(view, at=left, scale=ball)
sketch.add_items([ground])
[seeing facets] hatch(left, on_ball(sees_pole, (sees_pole & delaunay.closing).any()))
[closing hemisphere] for lines in (steep, steep * [1, -1]):
[closing hemisphere]     hatch(left, on_ball(delaunay.closing, True), lines)
sketch.add_items(items)
[pole] at = left + ball * view.project(lens(pole))
[pole front] sketch.add_points(at, name="pole", style=DotStyle(PAPER, 5.9, RED.color, 1.8))
[pole !front] sketch.add_circle(at, 5.0, name="pole", style=LineStyle(RED.color, 1.2))
[pole] sketch.add_label(at, "$P$", (11.0 if at[0] < left[0] else -11.0, 0.0), size=15.0, color="#ab4300")
page = sketch.page((0, 2 * size + gap, 0, size), width=2 * size + gap, background=PAPER)
page.shaded(0.33).save("sphere.svg")
`,De=200,Ne="cities().lonlat[cities().population >= 2_000_000]",Bt=`SphericalDelaunay.from_lonlat(airports().lonlat).nearest(lonlat=${Ne})`,qt={cities:Ne,airports:`airports().lonlat[np.unique(${Bt})]`,stars:"stars().lonlat[stars().magnitude <= 3.0]"};function Yt(e,n,t,s){let{sites:a,view:o,bubble:r,aim:l,step:i}=e,c=ce(e.map,e.twin),d=$=>i===null&&e.isOn($),h=[...d("bubble")&&r?.sites||[],...i===null?e.held:[i.site]],p={facets:a.facetCount>0,hemisphere:a.hasClosing,step:i!==null&&i.before.dimension===2,aimed:r!==null,held:h.length>0,pole:c!==null,front:c!==null&&c[2]>=0,hatched:d("seeing")||d("closing")&&a.hasClosing},g={...s,sites:qt[t.set]??X(a.lonlat,`${Oe(t.file)}.lonlat`),pole:S(n.pole),view:S(o.middle),aim:A(l).join(", "),lens:`(${S(A(n.lens.focus))}), magnification=${n.lens.magnification}`,held:h.join(", "),step:i===null?"":i.site+1};return Y(Vt,g,p,d)}function Xt(e,n,t,s){let{sites:a,sheet:o,view:r,isOn:l}=e,[i,c]=[e.p,e.q].filter(b=>b!==null),{contact:d,height:h}=n,p=a.count===0?[3,2]:s,g={facets:a.delaunay.dimension===2,flat:o.isFlat,area:a.rectangle.width>0&&a.rectangle.height>0,letters:i!==void 0,pair:c!==void 0&&i!==c,pole:n.seenPole!==null},$={points:X(a.places,`np.loadtxt(${JSON.stringify(t.file)}, delimiter=",", skiprows=1, usecols=(0, 1))`),corners:p?`np.array([[-1, -1], [1, 1]]) * [${S(p)}] / 2`:"points.min(axis=0), points.max(axis=0)",view:S(r.middle),width:n.width,height:h,scale:n.scale,contact:`${d[0]}, ${h-d[1]}`,corner:o.corner,pair:[i,c].join(", "),shown:JSON.stringify(n.grounds)};return Y(Gt,$,g,l)}function Kt(e,n,t,s,a){let{lens:o,sight:r,from:l,to:i,before:c,after:d,pointer:h}=e,{places:p,latitude:g,picture:$,resolution:b}=n,u=o==="bubble",{owner:m,names:y,lonlat:O=new Float64Array(0)}=p??{},D=Oe(p?.name??""),E=p===null||g==="spherical"?"":`, latitude="${g}"`,L=U=>{let M=`(${S(A(U))})`;return E===""?M:`lonlat_to_xyz(${M}${E})`},K=({middle:U,roll:M})=>S([...U,M]).replace(/, -?0$/,""),Me={focus:L(r.lens.focus),magnification:S([r.lens.magnification]),taken:`${L(l.center)}, ${S([l.radius])}`,filled:`${L(i.center)}, ${S([i.radius])}`,title:"",...m?.lines,file:D,places:X(O,`${D}.lonlat`),words:O.length>2*De?`${D}.column("name")`:JSON.stringify(y),latitude:E,picture:JSON.stringify($?.name??""),resolution:b,pointer:L(h),before:K(c),view:K(u?d:r.view),width:S([1.03*s*(u?2:1)])},{points:Ie,scale:ze}=m?.lines??{};return Y(Wt,Me,{bubble:u,picture:$,places:p,pointed:a,owned:Ie,scaled:ze,named:y},t)}function Y(e,n,t,s){let a=c=>c in t?!!t[c]:s(c),r=e.split(`
`).flatMap(c=>{let[,d,h]=/^(?:\[([!a-z ]+)\] )?(.*)$/.exec(c);return d?.split(" ").every(g=>g.startsWith("!")?!a(g.slice(1)):a(g))===!1?[]:[h]}).join(`
`).replace(/\{(\w+)\}/g,(c,d)=>String(n[d]??c)),l=r.replace(/^(from|import) .*\n/gm,""),i=c=>new RegExp(`\\b${c.split(" as ").pop()}\\b`).test(l);return r.replace(/^((?:from \S+ )?import )(.*)\n/gm,(c,d,h)=>{let p=h.split(", ").filter(i);return p.length===0?"":`${d}${p.join(", ")}
`})}function X(e,n){if(e.length>2*De)return n;let t=Array.from({length:e.length/2},(a,o)=>`[${e[2*o]}, ${e[2*o+1]}]`),s=t.join(", ").replace(/(.{1,82}\],) /g,`$1
    `);return t.length===0?"np.zeros((0, 2))":`np.array([
    ${s},
])`}var Oe=e=>`read_points(${JSON.stringify(e)})`;function S(e){return e.map(n=>z(n,7)).join(", ")}async function Jt(e,n){let t=e.cloneNode(!0);t.querySelector("#block-state")?.remove();let s=w("script",{type:"text/plain",id:"block-state"},await Zt(n));return t.querySelector("#block-kernel").before(s,`
`),new Blob([`<!doctype html>
`,t.outerHTML,`
`],{type:"text/html"})}async function Zt(e){let n=new Blob([e]).stream().pipeThrough(new CompressionStream("deflate")),t=new Uint8Array(await new Response(n).arrayBuffer());return btoa(Array.from(t,s=>String.fromCharCode(s)).join(""))}function Qt(e,n){let t=new Blob([n]),s=w("a",{href:URL.createObjectURL(t),download:e});s.click(),setTimeout(()=>URL.revokeObjectURL(s.href),6e4)}async function en(e){let{title:n,width:t,height:s,weight:a,paint:o}=await Ae(e,T().ink),r=new He(t,s,T(),a);return o(r),r.text(n)}async function tn(e,n){let{width:t,height:s,weight:a,paint:o}=await Ae(e,T().ink),r=w("canvas",{width:Math.round(t*n),height:Math.round(s*n)}),l=r.getContext("2d");return l.fillStyle=T().paper,l.fillRect(0,0,r.width,r.height),o(new J(l,t,s,n,T(),a)),new Promise((i,c)=>{r.toBlob(d=>d===null?c(new Error("the picture is too large")):i(d))})}var nn={csv:pt,download:Qt,geojson:xt,globePython:Kt,liftPython:Xt,openPanorama:Ct,openPoints:Le,savedPage:Jt,sheetPng:tn,sheetSvg:en,spherePython:Yt};Object.assign(document.currentScript,{offers:nn});})();
